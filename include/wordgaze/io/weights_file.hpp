#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "wordgaze/io/tensor.hpp"

/// What every file of ours with weights has in common; docs/formats.md has the layout.
namespace wordgaze::io {

inline constexpr std::string_view kWeightsFormat = "2";

/// Reads the file and makes sure that it is one of ours. Throws std::runtime_error that names the
/// file and what is wrong with it. That a file has no checksum is said on standard error.
TensorMap read_weights_file(const std::filesystem::path& path);

/// The configuration in it, as TOML. In a file of format 1 it also names what was a matter of
/// course then and is no more, so that the agent is read as what it was.
std::string configuration_text(const TensorMap& map);

/// Throws std::runtime_error: "checkpoint 'path': what".
[[noreturn]] void fail_weights_file(const std::filesystem::path& path, const std::string& what);

}  // namespace wordgaze::io
