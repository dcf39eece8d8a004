#include "wordgaze/training/rollout.hpp"

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

}  // namespace wordgaze::training
