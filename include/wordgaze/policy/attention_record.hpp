#pragma once
#include <vector>

namespace wordgaze::policy {

/// Where a lane looked in its last decision, over the 49 cells of the view, each number its own.
/// Empty without attention. What a map of the product gaze leaves of 1 is on nowhere: not in view.
struct AttentionRecord {
  std::vector<float> weights;  ///< w, one a word of the mission; sums to 1
  std::vector<float> mask;     ///< alpha, one a word; ones without the Task Attention Module
  std::vector<float> maps;     ///< A, 49 a word, row by row
  std::vector<float> gaze;     ///< M, 49
  std::vector<float> filter;   ///< s(M), 49: what the view is multiplied with
  float nowhere = 0;           ///< what M has on nowhere; 0 for a gaze that does not know it

  void clear() {
    for (auto* numbers : {&weights, &mask, &maps, &gaze, &filter}) numbers->clear();
    nowhere = 0;
  }
};

}  // namespace wordgaze::policy
