#include "wordgaze/policy/trained_agent.hpp"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/parameters.hpp"
#include "wordgaze/io/weights_file.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/policy/level_file.hpp"

namespace wordgaze::policy {
namespace {

/// What the settings make room for must be there: each size is one of some tensor. Asked before
/// anything is allocated.
void check_sizes(const io::TensorMap& map, const model::Config& c) {
  const auto expect = [&](std::string_view name, std::size_t axis, std::int64_t size,
                          std::string_view setting) {
    const io::Tensor& tensor = map.tensor(name);
    if (axis < tensor.shape.size() && tensor.shape[axis] == size) return;
    throw std::runtime_error(
        formatted("{} is {}, but model.{} in its configuration asks for {} along axis {}", name,
                  io::description(tensor), setting, size, axis));
  };
  expect("words", 0, c.word_size, "word_size");
  expect("memory.input_weight", 0, 4 * c.memory_size, "memory_size");
  expect("memory.input_weight", 1, grid::kViewCells * c.channels, "channels");
  expect("text.hidden_weight", 1, c.text_size, "text_size");
  expect("actor.hidden.weight", 0, c.head_size, "head_size");
  if (c.attention) expect("attention.query", 0, c.key_size, "key_size");
  if (c.task_attention && !model::scans(c)) {
    expect("task.hidden.weight", 0, c.task_size, "task_size");
  }
}

/// The cells of the level of a configuration.
model::CellAlphabet trained_alphabet(const std::string& configuration) {
  const std::string env = io::text_of("env", configuration, "wordgaze.config");
  try {
    return alphabet_of(level_of(env, io::text_of("level", configuration, "wordgaze.config")));
  } catch (const std::invalid_argument&) {
    return model::CellAlphabet::everything();  // a level of somebody's own
  }
}

TrainedAgent load_with(const std::filesystem::path& path, const model::CellAlphabet* alphabet) {
  const io::TensorMap map = io::read_weights_file(path);
  try {
    const std::string text = io::configuration_text(map);
    const auto config = io::parse_section<model::Config>(text, "model", "wordgaze.config");
    check_sizes(map, config);
    const Agent agent(config, alphabet != nullptr ? *alphabet : trained_alphabet(text));
    auto params = agent.make_params();
    io::get_parameters(
        map, "", [](const nn::Path&) { return false; }, params);
    return {{agent, agent.make_weights(std::move(params))}};
  } catch (const std::exception& error) {
    io::fail_weights_file(path, error.what());
  }
}

}  // namespace

TrainedAgent TrainedAgent::load(const std::filesystem::path& path) {
  return load_with(path, nullptr);
}

TrainedAgent TrainedAgent::load(const std::filesystem::path& path,
                                const model::CellAlphabet& alphabet) {
  return load_with(path, &alphabet);
}

}  // namespace wordgaze::policy
