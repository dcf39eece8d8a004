#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "command.hpp"
#include "output.hpp"
#include "wordgaze/page/live_page.hpp"

namespace wordgaze::apps {

/// What --watch asks for: the page of episodes while they happen.
struct Watch {
  bool wanted = false;
  std::string address = "127.0.0.1";
  int port = 8765;

  static void add_options(CLI::App& app, Watch& w) {
    app.add_flag("--watch", w.wanted, "show the episodes in a browser while they happen");
    add_place(app, w);
  }
  static void add_place(CLI::App& app, Watch& w) {
    app.add_option("--watch-port", w.port, "port of the page; 0: any that is free")
        ->check(whole_number(0, 65535))
        ->capture_default_str();
    app.add_option("--watch-address", w.address,
                   "address of this machine to listen on; another than 127.0.0.1 can be reached by "
                   "others, without a password")
        ->capture_default_str();
  }

  /// The page, which says where it is; null where none is wanted.
  std::unique_ptr<page::LivePage> open(page::LivePage::Options options) const {
    if (!wanted) return nullptr;
    options.address = address;
    options.port = port;
    auto live = std::make_unique<page::LivePage>(std::move(options));
    note("open {} in a browser\n", live->url());
    return live;
  }
};

}  // namespace wordgaze::apps
