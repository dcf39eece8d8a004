#include "wordgaze/training/rollout.hpp"

#include <algorithm>
#include <cmath>

namespace wordgaze::training {

Rollout::Rollout(const model::Config& model, const PpoConfig& ppo)
    : shape{ppo.steps, ppo.lanes}, chunk(ppo.chunk), missions(static_cast<std::size_t>(ppo.lanes)) {
  const auto n = shape.columns();
  const auto size = static_cast<std::size_t>(n);
  cells.setZero(grid::kViewCells, n);
  mission_of.assign(size, 0);
  keep.setOnes(1, n);
  completion.setZero(model.sub_tasks, n);
  for (auto* v : {&action, &ended}) v->assign(size, 0);
  bright.assign(size, 0);
  for (auto* v : {&log_prob, &value, &reward, &advantage}) v->assign(size, 0);
  next_value.assign(static_cast<std::size_t>(ppo.lanes), 0);
  start_h.setZero(model.memory_size, sequences());
  start_c.setZero(model.memory_size, sequences());
}

std::string first_not_finite(const Rollout& r) {
  const auto at = [](const char* what, Index step, Index lane) {
    return std::string("the ") + what + " of step " + std::to_string(step) + " in lane " +
           std::to_string(lane);
  };
  for (int s = 0; s < r.sequences(); ++s) {
    if (r.start_h.col(s).allFinite() && r.start_c.col(s).allFinite()) continue;
    return at("memory", s / r.shape.batch * r.chunk, r.lane(s));
  }
  struct Numbers {
    const char* what;
    const std::vector<float>& of;
    Index from;  // step
  };
  for (const auto& [what, of, from] :
       {Numbers{"value", r.value, 0}, Numbers{"value", r.next_value, r.shape.steps},
        Numbers{"log_prob", r.log_prob, 0}, Numbers{"reward", r.reward, 0},
        Numbers{"advantage", r.advantage, 0}}) {
    const auto bad =
        std::find_if_not(of.begin(), of.end(), [](float x) { return std::isfinite(x); });
    if (bad == of.end()) continue;
    const Index column = bad - of.begin();
    return at(what, from + column / r.shape.batch, column % r.shape.batch);
  }
  return "";
}

}  // namespace wordgaze::training
