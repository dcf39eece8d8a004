#include "wordgaze/training/checkpoint.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/safetensors.hpp"
#include "wordgaze/io/weights_file.hpp"

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

void put_rng(std::vector<std::int64_t>& to, const core::Rng::State& s) {
  for (const std::uint64_t word : {s.state_high, s.state_low, s.increment_high, s.increment_low,
                                   std::uint64_t{s.half}, std::uint64_t{s.has_half}}) {
    to.push_back(std::bit_cast<std::int64_t>(word));
  }
}

core::Rng::State get_rng(const std::int64_t* from) {
  const auto word = [&](int i) { return std::bit_cast<std::uint64_t>(from[i]); };
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
  const Tensor& tensor = map.tensor("train.outcomes");
  const auto count = tensor.shape.empty() ? 0 : tensor.shape[0];
  const auto& rows = values_of<double>(map, "train.outcomes", {count, 7});
  std::vector<Outcome> outcomes;
  for (auto row = rows.begin(); row != rows.end(); row += 7) {
    outcomes.push_back({{.success = row[3] != 0,
                         .truncated = row[4] != 0,
                         .steps = static_cast<int>(row[5]),
                         .episode_return = row[6]},
                        static_cast<babyai::Verb>(row[0]),
                        static_cast<int>(row[1]),
                        row[2] != 0});
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

std::vector<Lane> get_lanes(const TensorMap& map, const TrainConfig& config) {
  const std::int64_t n = config.ppo.lanes;
  const auto& environments = get_list<std::uint8_t>(map, "lanes.environment");
  const auto& sizes = values_of<std::int64_t>(map, "lanes.environment_size", {n});
  const auto& rngs = values_of<std::int64_t>(map, "lanes.rng", {n, kRngWords});
  const auto& counters = values_of<std::int64_t>(map, "lanes.counters", {n, kCounters});
  const auto& returns = values_of<double>(map, "lanes.return", {n});
  Matrix<float> h(config.model.memory_size, n), c = h;
  copy_tensor(map, "lanes.h", h);
  copy_tensor(map, "lanes.c", c);
  std::vector<Lane> lanes(static_cast<std::size_t>(n));
  std::size_t offset = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const auto size = static_cast<std::size_t>(sizes[i]);
    if (size > environments.size() - offset) {
      throw std::runtime_error("lanes.environment is shorter than lanes.environment_size says");
    }
    const auto* begin = environments.data() + offset;
    offset += size;
    const auto counter = [&](std::size_t k) {
      return counters[static_cast<std::size_t>(kCounters) * i + k];
    };
    const auto axis = [&](std::size_t k) {
      return Stretch::Axis{static_cast<int>(counter(k)), static_cast<int>(counter(k + 1))};
    };
    lanes[i] = {.environment = {begin, begin + size},
                .rng = get_rng(&rngs[i * kRngWords]),
                .helped = counter(2) != 0,
                .stretch = {.ahead = axis(3), .aside = axis(5)},
                .episode = counter(0),
                .episode_return = returns[i],
                .memory = {.begins = counter(1) != 0,
                           .h = h.col(static_cast<Index>(i)),
                           .c = c.col(static_cast<Index>(i))}};
  }
  return lanes;
}

}  // namespace

namespace detail {

void put_run(io::TensorMap& map, const TrainConfig& config, const RunState& state) {
  map.metadata["wordgaze.format"] = io::kWeightsFormat;
  map.metadata["wordgaze.config"] = io::to_toml(config);
  map.tensors.emplace("train.counters", list(std::vector<std::int64_t>{state.updates, state.frames,
                                                                       state.adam_steps}));
  map.tensors.emplace("train.reals", list(std::vector<double>{state.seconds, state.hit_12}));
  std::vector<std::int64_t> rng;
  put_rng(rng, state.rng);
  map.tensors.emplace("train.rng", list(std::move(rng)));
  map.tensors.emplace("train.curriculum", list(state.curriculum));
  put_outcomes(map, state.recent);
  put_lanes(map, state.lanes, config.model.memory_size);
}

RunState get_run(const io::TensorMap& map, const TrainConfig& config) {
  const auto& counters = values_of<std::int64_t>(map, "train.counters", {3});
  const auto& reals = values_of<double>(map, "train.reals", {2});
  const auto& rng = values_of<std::int64_t>(map, "train.rng", {kRngWords});
  return {.updates = counters[0],
          .frames = counters[1],
          .seconds = reals[0],
          .adam_steps = counters[2],
          .rng = get_rng(rng.data()),
          .curriculum = get_list<double>(map, "train.curriculum"),
          .recent = get_outcomes(map),
          .hit_12 = reals[1],
          .lanes = get_lanes(map, config)};
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
