#pragma once
#include <string>
#include <vector>

#include "command.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/policy/level_file.hpp"

/// --level FILE: levels of one's own.
namespace wordgaze::apps {

/// Makes the level of a file known by its id, which it returns.
inline std::string register_level_file(const std::string& path) {
  babyai::LevelSpec level = policy::load_level(path);
  std::string id = level.id;
  babyai::register_level(std::move(level));
  return id;
}

/// Adds --level, as often as wanted.
inline CLI::Option* add_level_option(CLI::App& app, std::vector<std::string>& files,
                                     const std::string& about) {
  return app.add_option("--level", files, "TOML file of a level of one's own " + about)
      ->type_name("FILE")
      ->allow_extra_args(false);
}

}  // namespace wordgaze::apps
