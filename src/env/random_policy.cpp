#include "wordgaze/env/random_policy.hpp"

#include <algorithm>

namespace wordgaze::env {

using grid::Action;
using grid::Type;

namespace {

constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15;

// FNV-1a.
std::uint64_t hash(std::string_view text) {
  std::uint64_t h = 0xCBF29CE484222325;
  for (char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  return h;
}

}  // namespace

RandomPolicy::RandomPolicy(std::string_view id, std::uint64_t seed, std::uint64_t policy_seed)
    : state_(hash(id) ^ (seed * kGolden) ^ policy_seed) {}

// splitmix64.
std::uint64_t RandomPolicy::next() {
  std::uint64_t z = state_ += kGolden;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
  z = (z ^ z >> 27) * 0x94D049BB133111EB;
  return z ^ z >> 31;
}

Action RandomPolicy::operator()(const Environment& env) {
  const Action action = choose(env);
  // Dynamic-Obstacles has three actions only.
  if (static_cast<int>(action) < env.num_actions()) return action;
  return static_cast<Action>(below(env.num_actions()));
}

Action RandomPolicy::choose(const Environment& env) {
  const grid::World& world = env.world();
  const Type ahead = world.object_at(world.front()).type;
  const bool carrying = world.carried != grid::kNothing;
  if (percent() < 12) return static_cast<Action>(below(env.num_actions()));
  if (env.spec().done_mode != babyai::DoneMode::off) {
    if (percent() < 6) return Action::done;
    const auto matched = env.matched();
    if (std::find(matched.begin(), matched.end(), 1) != matched.end() && percent() < 50) {
      return Action::done;
    }
  }
  switch (ahead) {
    case Type::key:
    case Type::ball:
    case Type::box: {
      const int q = percent();
      if (carrying) return q < 10 ? Action::toggle : q < 15 ? Action::drop : turn();
      return q < 55 ? Action::pickup : q < 63 ? Action::toggle : turn();
    }
    case Type::door: {
      const int q = percent();
      return q < 45 ? Action::toggle : q < 85 ? Action::forward : turn();
    }
    case Type::empty:
    case Type::floor:
      if (carrying) {
        const int q = percent();
        return q < 20 ? Action::drop : q < 75 ? Action::forward : turn();
      }
      [[fallthrough]];
    case Type::goal:
      return percent() < 75 ? Action::forward : turn();
    case Type::lava:
      return percent() < 8 ? Action::forward : turn();
    default:
      return turn();
  }
}

}  // namespace wordgaze::env
