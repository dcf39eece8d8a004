#pragma once
#include <filesystem>

#include "wordgaze/rl/trainer.hpp"

/// Checkpoints of training runs: one safetensors file that holds the weights by their names, the
/// configuration, and everything needed to go on. docs/formats.md has the layout.
namespace wordgaze::io {

/// All or nothing: a failure leaves the file that was there.
void save_checkpoint(const std::filesystem::path& path, const rl::TrainConfig& config,
                     const rl::TrainerState& state);

/// The configuration that a checkpoint was made with. Like the two below it throws
/// std::runtime_error that names the file and what is wrong with it.
rl::TrainConfig load_config(const std::filesystem::path& path);

/// The weights, for an agent of this configuration. `fresh` gives the values of leaves that
/// only a second phase has (`task` and `completion`) where the file lacks them. Any other
/// difference in names or shapes is an error.
rl::Agent::Params load_params(const std::filesystem::path& path, const model::Config& config,
                              const rl::Agent::Params* fresh = nullptr);

/// Everything, for Trainer::restore.
rl::TrainerState load_state(const std::filesystem::path& path, const rl::TrainConfig& config);

}  // namespace wordgaze::io
