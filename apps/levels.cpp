// levels: which environments there are.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>

#include "command.hpp"
#include "output.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/trace/level_docs.hpp"

namespace {

using namespace wordgaze;

struct Arguments {
  std::string pattern;
  bool ids = false, page = false;
};

int run(const Arguments& a) {
  if (a.page) {
    trace::write_level_docs(std::cout);
    return 0;
  }
  int shown = 0;
  for (const std::string& id : babyai::level_ids()) {
    if (id.find(a.pattern) == std::string::npos) continue;
    if (shown++ == 0 && !a.ids) {
      apps::say("{:<45} {:>7} {:>6} {:>6}  {}\n", "environment", "rooms", "cells", "steps",
                "a mission");
    }
    if (a.ids) {
      apps::say("{}\n", id);
      continue;
    }
    const babyai::LevelSpec level = babyai::find_level(id);
    env::Environment environment(level);
    environment.reset(1);
    const auto rooms = fmt::format("{}x{}", level.columns, level.rows);
    apps::say("{:<45} {:>7} {:>6} {:>6}  {}\n", id, rooms, level.room_size, environment.max_steps(),
              environment.mission());
  }
  require(
      shown > 0 || a.pattern.empty(),
      "no id contains '{}'; levels without a pattern lists all, and Wordgaze-One-N8-K4-v0 and its "
      "kin, of any size N and number of objects K, are not listed (docs/levels.md)",
      a.pattern);
  return 0;
}

}  // namespace

wordgaze::apps::Command wordgaze::apps::levels_command() {
  return {
      "levels", "Lists the environments: rooms, side of a room in cells, step limit, a mission.",
      [](CLI::App& app) {
        const auto a = std::make_shared<Arguments>();
        app.add_option("PATTERN", a->pattern, "only ids that contain this");
        app.add_flag("--ids", a->ids, "ids alone, one a line");
        app.add_flag("--page", a->page, "docs/levels.md: all levels with all forms of missions");
        return [a] { return run(*a); };
      }};
}
