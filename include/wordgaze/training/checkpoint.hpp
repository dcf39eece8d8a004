#pragma once
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "wordgaze/io/parameters.hpp"
#include "wordgaze/io/safetensors.hpp"
#include "wordgaze/io/weights_file.hpp"
#include "wordgaze/training/trainer.hpp"

/// Checkpoints of training runs: one safetensors file that holds the weights by their names, the
/// configuration, and everything needed to go on. docs/formats.md has the layout.
///
/// What cannot be read throws std::runtime_error that names the file and what is wrong with it.
namespace wordgaze::training {

namespace detail {
void put_run(io::TensorMap& map, const TrainConfig& config, const RunState& state);
RunState get_run(const io::TensorMap& map, const TrainConfig& config,
                 const babyai::LevelSpec& level);
/// Whether only a second phase of training has this leaf.
bool only_second_phase(const nn::Path& path);
}  // namespace detail

/// All or nothing: a failure leaves the file that was there; so do weights that are not finite. The
/// same run gives the same bytes: the seconds that it took are not in it.
template <class Params>
void save_checkpoint(const std::filesystem::path& path, const TrainConfig& config,
                     const TrainerState<Params>& state) {
  io::TensorMap map;
  detail::put_run(map, config, state);
  io::put_parameters(map, "", state.params);
  io::put_parameters(map, "adam.mean.", state.adam_mean);
  io::put_parameters(map, "adam.variance.", state.adam_variance);
  io::write_safetensors(path, map);
}

/// The configuration that a checkpoint was made with.
TrainConfig load_config(const std::filesystem::path& path);

/// The weights, for a trainer to start from. Leaves that only a second phase has (`task` and
/// `completion`) and words that the vocabulary did not have keep the trainer's own values where the
/// file lacks them. Any other difference in names or shapes is an error.
template <class Agent>
typename Agent::Params load_params(const std::filesystem::path& path,
                                   const BasicTrainer<Agent>& trainer) {
  const io::TensorMap map = io::read_weights_file(path);
  try {
    typename Agent::Params params = trainer.params();
    io::get_parameters(map, "", detail::only_second_phase, params);
    return params;
  } catch (const std::runtime_error& error) {
    io::fail_weights_file(
        path, std::string(error.what()) +
                  "; the [model] sizes of the configuration and of the checkpoint must agree");
  }
}

/// Everything, for Trainer::restore, each number in its range; but for the seconds that training
/// took.
template <class Agent>
typename BasicTrainer<Agent>::State load_state(const std::filesystem::path& path,
                                               const BasicTrainer<Agent>& trainer) {
  const io::TensorMap map = io::read_weights_file(path);
  try {
    const auto get = [&](const std::string& prefix, typename Agent::Params params) {
      io::get_parameters(
          map, prefix, [](const nn::Path&) { return false; }, params);
      return params;
    };
    const typename Agent::Params zero = trainer.agent().make_params();
    typename BasicTrainer<Agent>::State state{
        detail::get_run(map, trainer.config(), trainer.level()), get("", trainer.params()),
        get("adam.mean.", zero), get("adam.variance.", zero)};
    nn::for_each_parameter(
        [](const nn::Path& at, const auto& leaf) {
          if (leaf.size() > 0 && leaf.minCoeff() < 0) {
            throw std::runtime_error("adam.variance." + at.str() + " is negative somewhere");
          }
        },
        state.adam_variance);
    return state;
  } catch (const std::exception& error) {
    io::fail_weights_file(path, error.what());
  }
}

}  // namespace wordgaze::training
