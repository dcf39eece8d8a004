#pragma once
#include <filesystem>
#include <string_view>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/level_text.hpp"

/// Levels of one's own in TOML files and in configurations. (docs/own-level.md)
namespace wordgaze::policy {

/// What a file says; without an id, "Own-NAME-v0" for NAME.toml. Throws std::invalid_argument that
/// names file, line and key for what is wrong with it, std::runtime_error for a file that cannot be
/// read.
babyai::LevelText read_level_file(const std::filesystem::path& path);

/// The level of a file. Throws as read_level_file and babyai::level_of, with the name of the file.
babyai::LevelSpec load_level(const std::filesystem::path& path);

/// The level that a configuration means: that of its text, as read_level_file has it, if there is
/// one, else that of its id. Throws std::invalid_argument where the two disagree, and for what
/// find_level and level_of refuse.
babyai::LevelSpec level_of(std::string_view env, std::string_view text);

}  // namespace wordgaze::policy
