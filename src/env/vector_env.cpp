#include "wordgaze/env/vector_env.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "wordgaze/core/require.hpp"

namespace wordgaze::env {
namespace {

void check_size(const char* name, std::size_t size, std::size_t wanted) {
  require(size == 0 || size == wanted, "VectorEnv: {} has {} entries; expected {}, or none", name,
          size, wanted);
}

template <class T, class Value>
void write(std::span<T> out, int k, Value value) {
  if (!out.empty()) out[k] = static_cast<T>(value);
}

}  // namespace

VectorEnv::VectorEnv(const babyai::LevelSpec& spec, int size)
    : own_team_(std::make_unique<Team>(1)), team_(own_team_.get()) {
  require(size >= 1, "VectorEnv: {} environments; expected at least one", size);
  environments_.assign(size, Environment(spec));
  statistics_.resize(size);
  returns_.resize(size);
}

VectorEnv::VectorEnv(const babyai::LevelSpec& spec, int size, Team& team) : VectorEnv(spec, size) {
  own_team_.reset();
  team_ = &team;
}

void VectorEnv::reset(std::uint64_t first_seed, const BatchOutput& out) {
  check(out);
  for_each([&](int k) {
    environments_[k].reset(first_seed + static_cast<std::uint64_t>(k));
    begin_one(k, out);
  });
}

void VectorEnv::reset(std::span<const std::optional<core::Seed>> seeds, const BatchOutput& out,
                      std::span<const std::uint8_t> chosen) {
  check(out);
  require(seeds.size() == environments_.size(), "VectorEnv: {} seeds for {} environments",
          seeds.size(), environments_.size());
  require(chosen.empty() || chosen.size() == environments_.size(),
          "VectorEnv: {} choices for {} environments", chosen.size(), environments_.size());
  for_each([&](int k) {
    if (!chosen.empty() && chosen[k] == 0) return;
    if (seeds[k]) {
      environments_[k].reset(*seeds[k]);
    } else {
      environments_[k].reset();
    }
    begin_one(k, out);
  });
}

void VectorEnv::restore(int k, std::span<const std::uint8_t> state) {
  require(k >= 0 && k < size(), "VectorEnv: environment {} of {}", k, size());
  environments_[k].restore(state);
  begin_one(k, {});
}

void VectorEnv::observe(const BatchOutput& out) const {
  check(out);
  for (int k = 0; k < size(); ++k) write_view(k, out.images, out.directions);
}

void VectorEnv::begin_one(int k, const BatchOutput& out) {
  statistics_[k] = {};
  returns_[k] = 0;
  write_view(k, out.images, out.directions);
}

void VectorEnv::step(std::span<const grid::Action> actions, const BatchOutput& out) {
  check(out);
  require(actions.size() == environments_.size(), "VectorEnv: {} actions for {} environments",
          actions.size(), environments_.size());
  const int count = environments_.front().num_actions();
  for (std::size_t k = 0; k < actions.size(); ++k) {
    require(static_cast<int>(actions[k]) < count,
            "VectorEnv: action {} of environment {}; expected 0 to {}",
            static_cast<int>(actions[k]), k, count - 1);
  }
  for_each([&](int k) { step_one(k, actions[k], out); });
}

void VectorEnv::step_one(int k, grid::Action action, const BatchOutput& out) {
  Environment& env = environments_[k];
  const Transition transition = env.step(action);
  write(out.rewards, k, transition.reward);
  write(out.terminated, k, transition.terminated);
  write(out.truncated, k, transition.truncated);
  returns_[k] += transition.reward;
  if (transition.terminated || transition.truncated) {
    write_view(k, out.final_images, out.final_directions);
    EpisodeStatistics& statistics = statistics_[k];
    ++statistics.episodes;
    statistics.successes += transition.reward > 0;
    statistics.last_return = std::exchange(returns_[k], 0);
    statistics.last_length = env.step_count();
    env.reset();
  }
  write_view(k, out.images, out.directions);
}

void VectorEnv::write_view(int k, std::span<std::uint8_t> images,
                           std::span<std::uint8_t> directions) const {
  const Environment& env = environments_[k];
  if (!images.empty()) {
    const auto offset = static_cast<std::size_t>(k) * grid::kImageBytes;
    env.observe(images.subspan(offset).first<grid::kImageBytes>());
  }
  write(directions, k, env.direction());
}

void VectorEnv::check(const BatchOutput& out) const {
  const std::size_t n = environments_.size();
  check_size("images", out.images.size(), n * grid::kImageBytes);
  check_size("directions", out.directions.size(), n);
  check_size("rewards", out.rewards.size(), n);
  check_size("terminated", out.terminated.size(), n);
  check_size("truncated", out.truncated.size(), n);
  check_size("final_images", out.final_images.size(), n * grid::kImageBytes);
  check_size("final_directions", out.final_directions.size(), n);
}

template <class Each>
void VectorEnv::for_each(Each each) {
  team_->run([&](int worker) {
    const auto [begin, end] = team_->share(size(), worker);
    for (int k = begin; k < end; ++k) each(k);
  });
}

}  // namespace wordgaze::env
