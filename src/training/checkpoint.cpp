#include "wordgaze/training/checkpoint.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/safetensors.hpp"
#include "wordgaze/io/weights_file.hpp"
#include "wordgaze/policy/environment.hpp"

namespace wordgaze::training {
namespace {

using io::copy_tensor;
using io::Tensor;
using io::tensor_of;
using io::TensorMap;
using io::values_of;

using Lane = LaneGroup::LaneState;

template <class T>
Tensor list(std::vector<T> values) {
  const auto size = static_cast<std::int64_t>(values.size());
  return {{size}, std::move(values)};
}

/// The values of a one-dimensional tensor of any length.
template <class T>
const std::vector<T>& get_list(const TensorMap& map, std::string_view name) {
  const Tensor& tensor = map.tensor(name);
  const auto size = tensor.shape.size() == 1 ? tensor.shape[0] : -1;
  return values_of<T>(map, name, {size});
}

constexpr std::size_t kRngWords = 6;
constexpr std::int64_t kCounters = 7;  // of a lane
constexpr double kMostFrames = 1e15;   // as a configuration can ask for
constexpr std::size_t kRecent = 1000;  // outcomes
constexpr double kMostReturn = 1;      // of an episode, and the least is its opposite

/// Number k of a tensor, if it lies in the range: what is read is followed. NaN lies in none.
template <class T>
T within(std::string_view name, const std::vector<T>& values, std::size_t k,
         std::type_identity_t<T> low, std::type_identity_t<T> high) {
  if (values[k] >= low && values[k] <= high) return values[k];
  throw std::runtime_error(
      formatted("{}[{}] is {}; expected {} to {}", name, k, values[k], low, high));
}

int whole(std::string_view name, const std::vector<double>& values, std::size_t k, int low,
          int high) {
  const double value = within(name, values, k, low, high);
  if (std::trunc(value) != value) {
    throw std::runtime_error(formatted("{}[{}] is {}; expected a whole number", name, k, value));
  }
  return static_cast<int>(value);
}

void put_rng(std::vector<std::int64_t>& to, const core::Rng::State& s) {
  for (const std::uint64_t word : {s.state_high, s.state_low, s.increment_high, s.increment_low,
                                   std::uint64_t{s.half}, std::uint64_t{s.has_half}}) {
    to.push_back(std::bit_cast<std::int64_t>(word));
  }
}

core::Rng::State get_rng(std::string_view name, const std::vector<std::int64_t>& words,
                         std::size_t from) {
  const auto word = [&](std::size_t i) { return std::bit_cast<std::uint64_t>(words[from + i]); };
  within(name, words, from + 4, 0, std::numeric_limits<std::uint32_t>::max());
  within(name, words, from + 5, 0, 1);
  if (word(3) % 2 == 0) {
    throw std::runtime_error(
        formatted("{}[{}] is even; expected an increment, which is odd", name, from + 3));
  }
  return {.state_high = word(0),
          .state_low = word(1),
          .increment_high = word(2),
          .increment_low = word(3),
          .half = static_cast<std::uint32_t>(word(4)),
          .has_half = word(5) != 0};
}

void put_outcomes(TensorMap& map, const std::vector<Outcome>& outcomes) {
  std::vector<double> rows;
  for (const auto& o : outcomes) {
    rows.insert(rows.end(),
                {static_cast<double>(o.verb), double(o.clauses), double(o.helped),
                 double(o.success), double(o.truncated), double(o.steps), o.episode_return});
  }
  map.tensors.emplace("train.outcomes", Tensor{{std::int64_t(outcomes.size()), 7}, rows});
}

std::vector<Outcome> get_outcomes(const TensorMap& map) {
  constexpr std::string_view kName = "train.outcomes";
  constexpr std::size_t kColumns = 7;
  constexpr int kMostSteps = 1'000'000'000;
  const Tensor& tensor = map.tensor(kName);
  const auto count = tensor.shape.empty() ? 0 : tensor.shape[0];
  const auto& rows = values_of<double>(map, kName, {count, std::int64_t{kColumns}});
  if (rows.size() > kRecent * kColumns) {
    throw std::runtime_error(
        formatted("{} has {} rows; expected at most {}", kName, count, kRecent));
  }
  std::vector<Outcome> outcomes;
  for (std::size_t row = 0; row < rows.size(); row += kColumns) {
    const auto number = [&](std::size_t column, int high) {
      return whole(kName, rows, row + column, 0, high);
    };
    outcomes.push_back(
        {{.success = number(3, 1) != 0,
          .truncated = number(4, 1) != 0,
          .steps = number(5, kMostSteps),
          .episode_return = within(kName, rows, row + 6, -kMostReturn, kMostReturn)},
         static_cast<babyai::Verb>(number(0, static_cast<int>(babyai::Verb::put_next))),
         number(1, babyai::Instruction::kMaxClauses),
         number(2, 1) != 0});
  }
  return outcomes;
}

void put_lanes(TensorMap& map, const std::vector<Lane>& lanes, Index memory) {
  std::vector<std::uint8_t> environments;
  std::vector<std::int64_t> sizes, rngs, counters;
  std::vector<double> returns;
  Matrix<float> h(memory, static_cast<Index>(lanes.size())), c = h;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    environments.insert(environments.end(), lane.environment.begin(), lane.environment.end());
    sizes.push_back(static_cast<std::int64_t>(lane.environment.size()));
    put_rng(rngs, lane.rng);
    counters.insert(counters.end(),
                    {lane.episode, lane.memory.begins, lane.helped, lane.stretch.ahead.near,
                     lane.stretch.ahead.gap, lane.stretch.aside.near, lane.stretch.aside.gap});
    returns.push_back(lane.episode_return);
    h.col(static_cast<Index>(i)) = lane.memory.h;
    c.col(static_cast<Index>(i)) = lane.memory.c;
  }
  const auto n = static_cast<std::int64_t>(lanes.size());
  map.tensors.emplace("lanes.environment", list(std::move(environments)));
  map.tensors.emplace("lanes.environment_size", list(std::move(sizes)));
  map.tensors.emplace("lanes.rng", Tensor{{n, std::int64_t{kRngWords}}, std::move(rngs)});
  map.tensors.emplace("lanes.counters", Tensor{{n, kCounters}, std::move(counters)});
  map.tensors.emplace("lanes.return", list(std::move(returns)));
  map.tensors.emplace("lanes.h", tensor_of(h));
  map.tensors.emplace("lanes.c", tensor_of(c));
}

/// Throws unless a lane of the level can go on from its environment: an episode runs in it, and the
/// agent knows all that it may see.
void check_environment(env::Environment& environment, const Lane& lane) {
  environment.restore(lane.environment);
  const auto& objects = environment.world().objects;
  if (objects.empty()) throw std::runtime_error("no episode has begun");
  if (lane.memory.begins != (environment.step_count() == 0)) {
    throw std::runtime_error("its memory and its environment do not begin together");
  }
  const auto alphabet = policy::alphabet_of(environment.spec());
  for (std::size_t id = grid::kWall + 1; id < objects.size(); ++id) {
    const auto& [type, color, state, contents, position] = objects[id];
    const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
    if (alphabet.find({byte(type), byte(color), byte(state)}) >= 0) continue;
    throw std::runtime_error(
        formatted("a {} {}, which no view of this level shows", name(color), name(type)));
  }
}

std::vector<Lane> get_lanes(const TensorMap& map, const TrainConfig& config,
                            const babyai::LevelSpec& level, std::int64_t most_episodes) {
  constexpr std::string_view kCountersName = "lanes.counters", kReturns = "lanes.return",
                             kSizes = "lanes.environment_size";
  const std::int64_t n = config.ppo.lanes;
  const auto& environments = get_list<std::uint8_t>(map, "lanes.environment");
  const auto& sizes = values_of<std::int64_t>(map, kSizes, {n});
  const auto& rngs = values_of<std::int64_t>(map, "lanes.rng", {n, kRngWords});
  const auto& counters = values_of<std::int64_t>(map, kCountersName, {n, kCounters});
  const auto& returns = values_of<double>(map, kReturns, {n});
  Matrix<float> h(config.model.memory_size, n), c = h;
  copy_tensor(map, "lanes.h", h);
  copy_tensor(map, "lanes.c", c);
  env::Environment environment(level);
  std::vector<Lane> lanes(static_cast<std::size_t>(n));
  std::size_t offset = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const auto left = static_cast<std::int64_t>(environments.size() - offset);
    const auto size = static_cast<std::size_t>(within(kSizes, sizes, i, 0, left));
    const auto* begin = environments.data() + offset;
    offset += size;
    const auto counter = [&](std::size_t k, std::int64_t high) {
      return within(kCountersName, counters, static_cast<std::size_t>(kCounters) * i + k, 0, high);
    };
    const auto axis = [&](std::size_t k) {
      return Stretch::Axis{static_cast<int>(counter(k, grid::kViewSize)),
                           static_cast<int>(counter(k + 1, grid::kViewSize))};
    };
    lanes[i] = {.environment = {begin, begin + size},
                .rng = get_rng("lanes.rng", rngs, i * kRngWords),
                .helped = counter(2, 1) != 0,
                .stretch = {.ahead = axis(3), .aside = axis(5)},
                .episode = counter(0, most_episodes),
                .episode_return = within(kReturns, returns, i, -kMostReturn, kMostReturn),
                .memory = {.begins = counter(1, 1) != 0,
                           .h = h.col(static_cast<Index>(i)),
                           .c = c.col(static_cast<Index>(i))}};
    try {
      check_environment(environment, lanes[i]);
    } catch (const std::exception& error) {
      throw std::runtime_error(formatted("lanes.environment, lane {}: {}", i, error.what()));
    }
  }
  if (offset != environments.size()) {
    throw std::runtime_error("lanes.environment is longer than lanes.environment_size says");
  }
  return lanes;
}

/// hit_12; older files have the seconds of training before it.
double get_hit_12(const TensorMap& map) {
  constexpr std::string_view kName = "train.reals";
  const bool older = map.tensor(kName).shape == std::vector<std::int64_t>{2};
  const auto& reals = values_of<double>(map, kName, {older ? 2 : 1});
  return std::isnan(reals.back()) ? reals.back() : within(kName, reals, reals.size() - 1, 0, 1);
}

std::vector<double> get_curriculum(const TensorMap& map, const TrainConfig& config) {
  const auto& state = get_list<double>(map, "train.curriculum");
  try {
    Curriculum(config.curriculum).restore(state);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(formatted("train.curriculum: {}", error.what()));
  }
  return state;
}

}  // namespace

namespace detail {

void put_run(io::TensorMap& map, const TrainConfig& config, const RunState& state) {
  map.metadata["wordgaze.format"] = io::kWeightsFormat;
  map.metadata["wordgaze.config"] = io::to_toml(config);
  map.tensors.emplace("train.counters", list(std::vector<std::int64_t>{state.updates, state.frames,
                                                                       state.adam_steps}));
  map.tensors.emplace("train.reals", list(std::vector<double>{state.hit_12}));
  std::vector<std::int64_t> rng;
  put_rng(rng, state.rng);
  map.tensors.emplace("train.rng", list(std::move(rng)));
  map.tensors.emplace("train.curriculum", list(state.curriculum));
  put_outcomes(map, state.recent);
  put_lanes(map, state.lanes, config.model.memory_size);
}

RunState get_run(const io::TensorMap& map, const TrainConfig& config,
                 const babyai::LevelSpec& level) {
  constexpr std::string_view kName = "train.counters";
  const auto& counters = values_of<std::int64_t>(map, kName, {3});
  const auto& rng = values_of<std::int64_t>(map, "train.rng", {kRngWords});
  const std::int64_t rollout = std::int64_t{config.ppo.lanes} * config.ppo.steps;
  const std::int64_t updates =
      within(kName, counters, 0, 0, static_cast<std::int64_t>(kMostFrames) / rollout);
  const std::int64_t frames = within(kName, counters, 1, updates * rollout, updates * rollout);
  const std::int64_t most_steps = updates * config.ppo.epochs * config.ppo.minibatches;
  return {.updates = updates,
          .frames = frames,
          .adam_steps = within(kName, counters, 2, 0, most_steps),
          .rng = get_rng("train.rng", rng, 0),
          .curriculum = get_curriculum(map, config),
          .recent = get_outcomes(map),
          .hit_12 = get_hit_12(map),
          .lanes = get_lanes(map, config, level, updates * config.ppo.steps)};
}

bool only_second_phase(const nn::Path& path) {
  return path.names[0] == "task" || path.names[0] == "completion";
}

}  // namespace detail

TrainConfig load_config(const std::filesystem::path& path) {
  const io::TensorMap map = io::read_weights_file(path);
  try {
    return io::parse_config<TrainConfig>(io::configuration_text(map), "wordgaze.config");
  } catch (const std::exception& error) {
    io::fail_weights_file(path, error.what());
  }
}

}  // namespace wordgaze::training
