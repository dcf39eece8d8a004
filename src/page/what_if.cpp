#include "what_if.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "shares.hpp"
#include "wordgaze/grid/cell.hpp"

namespace wordgaze::page {
namespace {

/// The policies, a text a column.
std::vector<std::string> columns(const Matrix<float>& policies, std::size_t actions) {
  std::vector<std::string> texts;
  for (Index n = 0; n < policies.cols(); ++n) {
    texts.push_back(shares({policies.col(n).data(), actions}));
  }
  return texts;
}

/// Cells whose deletion can be asked for: those that show more than a wall or nothing.
std::vector<Index> cells_to_delete(std::span<const std::uint8_t, grid::kImageBytes> image) {
  std::vector<Index> cells;
  for (Index c = 0; c < grid::kViewCells; ++c) {
    const auto type = static_cast<grid::Type>(image[static_cast<std::size_t>(3 * c)]);
    if (type > grid::Type::wall) cells.push_back(c);
  }
  return cells;
}

babyai::Sentence without(const babyai::Sentence& sentence, int word) {
  babyai::Sentence rest;
  for (int i = 0; i < sentence.length; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i != word) rest.append(sentence.words[k], sentence.sub_task_of[k]);
  }
  return rest;
}

}  // namespace

nlohmann::ordered_json what_if(const evaluation::DecisionContext& context) {
  policy::Policy& policy = context.policy;
  const std::size_t actions = policy.logits(context.lane).size();
  nlohmann::ordered_json json;

  const auto cells = cells_to_delete(context.observation.image);
  if (!cells.empty()) {
    const auto blank = static_cast<std::uint8_t>(policy.design().alphabet.find({0, 0, 0}));
    model::CellMatrix views =
        policy.frames().cells.col(context.lane).replicate(1, static_cast<Index>(cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) views(cells[i], static_cast<Index>(i)) = blank;
    const auto texts = columns(policy.policies_for(context.lane, views), actions);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      json["cells"][std::to_string(cells[i])] = texts[i];
    }
  }

  const babyai::Sentence& sentence = policy.sentence(context.lane);
  if (sentence.length > 1) {
    std::vector<babyai::Sentence> missions;
    for (int i = 0; i < sentence.length; ++i) missions.push_back(without(sentence, i));
    json["words"] = columns(policy.policies_for(context.lane, missions), actions);
  }
  return json;
}

}  // namespace wordgaze::page
