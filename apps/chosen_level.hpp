#pragma once
#include <string>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/policy/level_file.hpp"

namespace wordgaze::apps {

/// The level of a file (--level), or of an id (--env), or else the one that was trained in.
inline babyai::LevelSpec chosen_level(const std::string& file, const std::string& env,
                                      const std::string& trained_env = "",
                                      const std::string& trained_text = "") {
  if (!file.empty()) return policy::load_level(file);
  if (env.empty() || env == trained_env) return policy::level_of(trained_env, trained_text);
  return babyai::find_level(env);
}

}  // namespace wordgaze::apps
