#include "wordgaze/training/batch.hpp"

#include <algorithm>
#include <cmath>

namespace wordgaze::training {

AdvantageScale advantage_scale(const Rollout& rollout, std::span<const int> sequences,
                               double floor) {
  double sum = 0, squares = 0;
  for (const int s : sequences) {
    for (Index t = 0; t < rollout.chunk; ++t) {
      const double a = rollout.advantage[static_cast<std::size_t>(rollout.column(s, t))];
      sum += a;
      squares += a * a;
    }
  }
  const double frames = static_cast<double>(sequences.size()) * rollout.chunk;
  const double mean = sum / frames;
  const double deviation = std::sqrt(std::max(0.0, squares / frames - mean * mean));
  return {mean, 1 / std::max({deviation, floor, 1e-8})};
}

template <std::floating_point S>
void BasicBatch<S>::gather(const model::Config& config, const Rollout& r,
                           std::span<const int> sequences, const AdvantageScale& scale) {
  const nn::SequenceShape shape{r.chunk, static_cast<Index>(sequences.size())};
  model::Frames<S>& x = frames;
  if (x.shape != shape) {
    x.resize(config, shape);
    const auto n = static_cast<std::size_t>(shape.columns());
    action.resize(n);
    bright.resize(n);
    for (auto* numbers : {&log_prob, &advantage, &value_target}) numbers->resize(n);
  }
  actions = r.actions;
  missions.clear();
  for (Index b = 0; b < shape.batch; ++b) {
    const int sequence = sequences[static_cast<std::size_t>(b)];
    x.start.h.col(b) = r.start_h.col(sequence).template cast<S>();
    x.start.c.col(b) = r.start_c.col(sequence).template cast<S>();
    int known = -1, local = 0;  // a mission lasts for an episode: look it up when it changes
    for (Index t = 0; t < shape.steps; ++t) {
      const Index to = shape.column(t, b), column = r.column(sequence, t);
      const auto i = static_cast<std::size_t>(to), from = static_cast<std::size_t>(column);
      const bool changed = model::scans(config) && t > 0 &&
                           r.completion.col(column) != r.completion.col(r.column(sequence, t - 1));
      if (r.mission_of[from] != known || changed) {
        known = r.mission_of[from];
        model::Mission mission{r.mission(r.lane(sequence), column), {}};
        if (model::scans(config)) {
          for (Index k = 0; k < r.completion.rows(); ++k) {
            mission.done[static_cast<std::size_t>(k)] = r.completion(k, column) > 0;
          }
        }
        local = missions.index_of(mission);
      }
      x.mission_of[i] = local;
      x.cells.col(to) = r.cells.col(column);
      x.keep(0, to) = static_cast<S>(r.keep(0, column));
      x.completion.col(to) = r.completion.col(column).template cast<S>();
      action[i] = r.action[from];
      bright[i] = r.bright[from];
      log_prob[i] = static_cast<S>(r.log_prob[from]);
      advantage[i] = static_cast<S>(scale(static_cast<double>(r.advantage[from])));
      value_target[i] = static_cast<S>(r.advantage[from]) + static_cast<S>(r.value[from]);
    }
  }
}

template struct BasicBatch<float>;
template struct BasicBatch<double>;

}  // namespace wordgaze::training
