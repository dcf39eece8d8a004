#pragma once
#include <cstdint>

#include <nlohmann/json.hpp>

#include "wordgaze/env/environment.hpp"

/// What reset and step records hold, from our side.
namespace wordgaze::trace {

using Json = nlohmann::ordered_json;

/// The record of the reset that has just happened, without what only the recorder knows: seed,
/// chain and episode.
Json reset_record(const env::Environment& env);

/// The record of a step.
Json step_record(const env::Environment& env, grid::Action action,
                 const env::Transition& transition);

/// CRC-32 of the view and of the whole grid: what compact traces hold in their place.
std::uint32_t image_checksum(const env::Environment& env);
std::uint32_t grid_checksum(const env::Environment& env);

}  // namespace wordgaze::trace
