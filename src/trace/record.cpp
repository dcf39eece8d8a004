#include "wordgaze/trace/record.hpp"

#include <ostream>

#include "records.hpp"
#include "wordgaze/babyai/level.hpp"

namespace wordgaze::trace {
namespace {

class Recorder {
 public:
  Recorder(const RecordOptions& options, const std::string& id, std::ostream& out)
      : options_(options), env_(level(id)), out_(out) {}

  void record_stream(std::uint64_t seed) {
    const env::Policy policy = options_.policy(env_.id(), seed, options_.policy_seed);
    int episode = 0;
    env_.reset(seed);
    write_reset(seed, seed, episode);
    for (int n = 0; n < options_.steps; ++n) {
      const grid::Action action = policy(env_);
      const env::Transition transition = env_.step(action);
      out_ << step_record(env_, action, transition) << '\n';
      if (!transition.terminated && !transition.truncated) continue;
      env_.reset();
      write_reset(nullptr, seed, ++episode);
    }
  }

 private:
  babyai::LevelSpec level(const std::string& id) const {
    babyai::LevelSpec level = babyai::find_level(id);
    if (options_.done_actions && level.done_mode == babyai::DoneMode::off) {
      level.done_mode = babyai::DoneMode::exact;
    }
    return level;
  }

  void write_reset(const Json& seed, std::uint64_t chain, int episode) {
    Json record = reset_record(env_);
    record["seed"] = seed;
    record["chain"] = chain;
    record["ep"] = episode;
    record["done_actions"] = options_.done_actions;
    out_ << record << '\n';
  }

  const RecordOptions& options_;
  env::Environment env_;
  std::ostream& out_;
};

}  // namespace

void record(const RecordOptions& options, std::ostream& out) {
  out << Json{{"t", "meta"},
              {"policy", options.policy_name},
              {"policy_seed", options.policy_seed},
              {"seeds", {options.first_seed, options.end_seed}},
              {"steps", options.steps},
              {"done_actions", options.done_actions}}
      << '\n';
  for (const std::string& id : options.ids) {
    Recorder recorder(options, id, out);
    for (auto seed = options.first_seed; seed < options.end_seed; ++seed) {
      recorder.record_stream(static_cast<std::uint64_t>(seed));
    }
  }
}

}  // namespace wordgaze::trace
