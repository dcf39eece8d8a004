// levels: which environments there are.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "command.hpp"
#include "output.hpp"
#include "own_level.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/draw/image.hpp"
#include "wordgaze/draw/tile.hpp"
#include "wordgaze/env/environment.hpp"
#include "wordgaze/trace/level_docs.hpp"

namespace {

using namespace wordgaze;

constexpr int kTileSize = 32;  // pixels

struct Arguments {
  std::string pattern, pictures;
  std::vector<std::string> levels;
  bool ids = false, page = false;
};

int run(const Arguments& a) {
  if (a.page) {
    trace::write_level_docs(std::cout);
    return 0;
  }
  for (const auto& file : a.levels) apps::register_level_file(file);
  draw::TileRenderer renderer(kTileSize);
  if (!a.pictures.empty()) std::filesystem::create_directories(a.pictures);
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
    if (!a.pictures.empty()) {
      draw::write_png(std::filesystem::path(a.pictures) / (id + ".png"),
                      renderer.world(environment.world()));
    }
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
        apps::add_level_option(app, a->levels, "to list with the others (docs/own-level.md)");
        auto* ids = app.add_flag("--ids", a->ids, "ids alone, one a line");
        app.add_option("--pictures", a->pictures,
                       "folder for a picture (PNG) of each, the world of seed 1 as ID.png")
            ->excludes(ids);
        app.add_flag("--page", a->page, "docs/levels.md: all levels with all forms of missions");
        return [a] { return run(*a); };
      }};
}
