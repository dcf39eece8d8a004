#pragma once
#include <nlohmann/json.hpp>

#include "wordgaze/env/environment.hpp"

/// What reset and step records hold, from our side.
namespace wordgaze::env {

using Json = nlohmann::ordered_json;

/// The record of the reset that has just happened, without what only the recorder knows: seed,
/// chain and episode.
Json reset_record(const Environment& env);

/// The record of a step.
Json step_record(const Environment& env, grid::Action action, const Transition& transition);

}  // namespace wordgaze::env
