#pragma once
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "wordgaze/policy/observer.hpp"
#if WORDGAZE_WITH_LCM
#include "wordgaze/lcm/live_publisher.hpp"
#include "wordgaze/lcm/log_writer.hpp"
#endif

namespace wordgaze::apps {

/// What --lcm-log and --lcm-url ask for: every listener hears the same.
class Listeners final : public policy::Observer {
 public:
  struct Options {
    std::string log, url;    ///< empty: not wanted
    std::string run_id;      ///< joins the messages of one run
    std::string checkpoint;  ///< file of the weights; empty while training
    int every = 1;           ///< of the episodes, each `every`-th
    bool append = false;     ///< go on with an existing log
  };

  explicit Listeners(const Options& options) {
#if WORDGAZE_WITH_LCM
    const lcm_io::Origin origin{options.run_id, options.checkpoint};
    if (!options.log.empty()) {
      using Mode = lcm_io::LogWriter::Mode;
      listeners_.push_back(std::make_unique<lcm_io::LogWriter>(
          options.log, origin, options.every, options.append ? Mode::append : Mode::create));
    }
    if (!options.url.empty()) {
      auto live = std::make_unique<lcm_io::LivePublisher>(options.url, origin, options.every);
      if (!live->problem().empty()) std::fprintf(stderr, "warning: %s\n", live->problem().c_str());
      live_ = live.get();
      listeners_.push_back(std::move(live));
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
#endif
  }

  /// Null when nobody listens: records need not be made.
  policy::Observer* observer() { return listeners_.empty() ? nullptr : this; }

  bool wants_episode(std::int64_t episode) override {
    bool wanted = false;
    for (const auto& l : listeners_) wanted = l->wants_episode(episode) || wanted;
    return wanted;
  }
  void on_begin(const policy::EpisodeBegin& r) override {
    for (const auto& l : listeners_) l->on_begin(r);
  }
  void on_step(const policy::StepRecord& r) override {
    for (const auto& l : listeners_) l->on_step(r);
  }
  void on_end(const policy::EpisodeEnd& r) override {
    for (const auto& l : listeners_) l->on_end(r);
  }
  void on_update(const policy::UpdateRecord& r) override {
    for (const auto& l : listeners_) l->on_update(r);
  }

 private:
  std::vector<std::unique_ptr<policy::Observer>> listeners_;
#if WORDGAZE_WITH_LCM
  const lcm_io::LivePublisher* live_ = nullptr;
#endif
};

}  // namespace wordgaze::apps
