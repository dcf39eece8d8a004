#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "wordgaze/policy/observers.hpp"
#if WORDGAZE_WITH_LCM
#include "wordgaze/lcm/live_publisher.hpp"
#include "wordgaze/lcm/log_writer.hpp"
#endif

namespace wordgaze::apps {

/// The name of the run in a folder, however the folder is written: "b" for b/, ./b and b/.
inline std::string run_name(const std::filesystem::path& folder, std::int64_t seed) {
  std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string() + "-" + std::to_string(seed);
}

/// What --lcm-log and --lcm-url ask for: every listener hears the same.
class Listeners final : public policy::Observer {
 public:
  struct Options {
    std::string log, url;                ///< empty: not wanted
    std::string run_id;                  ///< joins the messages of one run
    std::string checkpoint;              ///< file of the weights; empty while training
    int every = 1;                       ///< of the episodes, each `every`-th
    std::optional<std::int64_t> update;  ///< go on with an existing log from this update on
  };

  static void add_options(CLI::App& app, Options& options, const std::string& about_log) {
    const CLI::Validator given(
        [](const std::string& text) {
          return text.empty() ? std::string("expected a name; came an empty text") : std::string();
        },
        "");
    app.add_option("--lcm-log", options.log, about_log)->check(given);
    app.add_option("--lcm-url", options.url,
                   "publish the same live, as udpm:// or udpm://239.255.76.67:7667?ttl=0")
        ->check(given);
  }

  explicit Listeners(const Options& options) {
#if WORDGAZE_WITH_LCM
    const lcm_io::Origin origin{options.run_id, options.checkpoint};
    // The URL first: it may be refused, and then no log has been touched.
    if (!options.url.empty()) {
      auto live = std::make_unique<lcm_io::LivePublisher>(options.url, origin, options.every);
      warn(live->problem());
      live_ = live.get();
      heard_.add(live.get());
      listeners_.push_back(std::move(live));
    }
    if (!options.log.empty()) {
      auto log =
          std::make_unique<lcm_io::LogWriter>(options.log, origin, options.every, options.update);
      warn(log->gap());
      log_ = log.get();
      heard_.add(log.get());
      listeners_.push_back(std::move(log));
    }
#else
    if (!options.log.empty() || !options.url.empty()) {
      throw std::invalid_argument(
          "--lcm-log and --lcm-url: this program was built without LCM; install liblcm-dev and "
          "configure with -DWORDGAZE_WITH_LCM=ON");
    }
#endif
  }

  /// Says how many messages were lost on the way out, if any were.
  ~Listeners() override {
#if WORDGAZE_WITH_LCM
    if (live_ != nullptr && live_->dropped() > 0) {
      std::fprintf(stderr, "LCM: %lld messages were dropped rather than waited for\n",
                   static_cast<long long>(live_->dropped()));
    }
    if (log_ != nullptr && log_->lost() > 0) {
      std::fprintf(stderr, "LCM: %lld messages are missing at the end of the log\n",
                   static_cast<long long>(log_->lost()));
    }
#endif
  }

  /// Null when nobody listens: records need not be made.
  policy::Observer* observer() { return heard_.or_null() == nullptr ? nullptr : this; }

  void on_run(std::string_view run_id) override { heard_.on_run(run_id); }
  bool wants_episode(std::int64_t episode) override { return heard_.wants_episode(episode); }
  bool wants_scenes() const override { return heard_.wants_scenes(); }
  void on_begin(const policy::EpisodeBegin& r) override {
    heard_.on_begin(r);
    say_problem();
  }
  void on_scene(const policy::SceneRecord& r) override {
    heard_.on_scene(r);
    say_problem();
  }
  void on_step(const policy::StepRecord& r) override {
    heard_.on_step(r);
    say_problem();
  }
  void on_end(const policy::EpisodeEnd& r) override {
    heard_.on_end(r);
    say_problem();
  }
  void on_update(const policy::UpdateRecord& r) override {
    heard_.on_update(r);
    say_problem();
  }

 private:
  static void warn(const std::string& what) {
    if (!what.empty()) std::fprintf(stderr, "warning: %s\n", what.c_str());
  }
  /// A log that cannot be written is no reason to end what it is the log of.
  void say_problem() {
#if WORDGAZE_WITH_LCM
    if (said_ || log_ == nullptr || log_->problem().empty()) return;
    warn(log_->problem());
    said_ = true;
#endif
  }

  std::vector<std::unique_ptr<policy::Observer>> listeners_;
  policy::Observers heard_;
#if WORDGAZE_WITH_LCM
  const lcm_io::LivePublisher* live_ = nullptr;
  const lcm_io::LogWriter* log_ = nullptr;
  bool said_ = false;
#endif
};

}  // namespace wordgaze::apps
