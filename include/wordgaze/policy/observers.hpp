#pragma once
#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "wordgaze/policy/observer.hpp"

namespace wordgaze::policy {

/// Several observers as one. Each hears of an episode that any of them wants: it leaves out what it
/// did not ask for itself. They must outlive this.
class Observers final : public Observer {
 public:
  void add(Observer* observer) {
    if (observer != nullptr) all_.push_back(observer);
  }
  /// Null when nobody listens: records need not be made.
  Observer* or_null() { return all_.empty() ? nullptr : this; }

  void on_run(std::string_view run_id) override {
    for (Observer* o : all_) o->on_run(run_id);
  }
  bool wants_episode(std::int64_t episode) override {
    bool wanted = false;
    for (Observer* o : all_) wanted = o->wants_episode(episode) || wanted;
    return wanted;
  }
  bool wants_scenes() const override {
    return std::ranges::any_of(all_, [](const Observer* o) { return o->wants_scenes(); });
  }
  void on_begin(const EpisodeBegin& r) override {
    for (Observer* o : all_) o->on_begin(r);
  }
  void on_scene(const SceneRecord& r) override {
    for (Observer* o : all_) o->on_scene(r);
  }
  void on_step(const StepRecord& r) override {
    for (Observer* o : all_) o->on_step(r);
  }
  void on_end(const EpisodeEnd& r) override {
    for (Observer* o : all_) o->on_end(r);
  }
  void on_update(const UpdateRecord& r) override {
    for (Observer* o : all_) o->on_update(r);
  }

 private:
  std::vector<Observer*> all_;
};

}  // namespace wordgaze::policy
