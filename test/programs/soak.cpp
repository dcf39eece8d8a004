// soak: robots in simulated rooms that ask a running `wordgaze serve` over a network which loses,
// repeats and reorders, among garbage; each answer is compared with a policy of the robot's own.
// scripts/soak runs it at length, the tests for a moment.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/lcm/origin.hpp"
#include "wordgaze/nn/categorical.hpp"
#include "wordgaze/policy/environment.hpp"

namespace {

using namespace wordgaze;
using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string checkpoint, url, env = "Wordgaze-One-N8-K4-v0";
  std::int64_t requests = 100'000;
  std::int64_t robots = 8;
  std::int64_t server = 0;  ///< its process, to look at its memory; 0: not
  std::uint32_t seed = 1;
  double lost = 5, repeated = 5, late = 3, garbage = 5;  ///< percent
};

struct Tally {
  std::int64_t sent = 0, lost = 0, repeated = 0, late = 0,
               garbage = 0;  ///< on the way to the server
  std::int64_t retries = 0, restarts = 0;
  std::int64_t answers = 0, again = 0, evicted = 0, told_late = 0;  ///< replies
  std::int64_t wrong = 0;
  std::int64_t episodes = 0, successes = 0;
  std::vector<double> latency;  ///< s, of requests that were sent once
};

/// One robot, its world, and what it has to be told.
struct Robot {
  Robot(const Options& options, const policy::TrainedAgent& agent, std::int64_t number)
      : environment(options.env),
        reference(agent),
        seed(1'000'000 * static_cast<std::uint64_t>(number + 1)),
        is_slow(number + 3 >= options.robots) {}

  env::Environment environment;
  policy::NetworkPolicy<policy::Agent> reference;
  std::uint64_t seed;  // of the next episode
  bool is_slow;
  policy::Request waiting;
  policy::Reply expected;
  std::map<std::int64_t, policy_reply_t> heard;  // to the last numbers, lost ones too
  int times_sent = 0;
  Clock::time_point sent_at, next_action;
};

bool near(float a, float b) { return std::abs(a - b) <= 1e-4f * std::max(1.0f, std::abs(b)); }
bool near(std::span<const float> a, std::span<const float> b) {
  return std::ranges::equal(a, b, [](float x, float y) { return near(x, y); });
}

/// Bytes that a process has in memory.
std::int64_t resident(std::int64_t process) {
  std::ifstream status(fmt::format("/proc/{}/statm", process));
  std::int64_t size = 0, pages = 0;
  status >> size >> pages;
  require(pages > 0, "soak: process {} is not there: did the server end?", process);
  return pages * 4096;
}

class Soak {
 public:
  explicit Soak(const Options& options)
      : options_(options),
        agent_(policy::TrainedAgent::load(options.checkpoint,
                                          policy::alphabet_of(babyai::find_level(options.env)))),
        bus_(options.url),
        random_(options.seed) {
    require(bus_.good(), "soak: cannot open '{}'", options.url);
    using Hear = void (*)(const lcm::ReceiveBuffer*, const std::string&, Soak*);
    const Hear on_message = [](const lcm::ReceiveBuffer* received, const std::string&, Soak* it) {
      const auto* data = static_cast<const std::uint8_t*>(received->data);
      it->replies_.emplace_back(data, data + received->data_size);
    };
    bus_.subscribeFunction(std::string(lcm_io::kPolicyReplyChannel), on_message, this)
        ->setQueueCapacity(4096);
    for (std::int64_t n = 0; n < options.robots; ++n) {
      robots_.emplace_back(options, agent_, n);
      restart(robots_.back());
    }
  }

  void run() {
    const auto begin = Clock::now();
    std::optional<std::int64_t> memory_before;
    auto last_answer = begin;
    while (tally_.sent < options_.requests && tally_.wrong < 10) {
      const std::int64_t answers = tally_.answers;
      for (Robot& robot : robots_) act(robot);
      bus_.handleTimeout(1);
      while (bus_.handleTimeout(0) > 0) {
      }
      for (const Bytes& reply : std::exchange(replies_, {})) hear(reply);
      if (tally_.answers > answers) last_answer = Clock::now();
      require(Clock::now() - last_answer < std::chrono::seconds(10),
              "soak: nobody answers on {}; is `wordgaze serve` running?", options_.url);
      if (!memory_before && tally_.sent > options_.requests / 5 && options_.server > 0) {
        memory_before = resident(options_.server);
      }
    }
    report(std::chrono::duration<double>(Clock::now() - begin).count());
    if (memory_before) {
      const std::int64_t after = resident(options_.server);
      fmt::print("memory of the server: {:.1f} MB after a fifth, {:.1f} MB at the end\n",
                 static_cast<double>(*memory_before) / 1e6, static_cast<double>(after) / 1e6);
      if (after - *memory_before > 4 << 20) ++tally_.wrong;
    }
  }

  const Tally& tally() const { return tally_; }

 private:
  bool chance(double percent) {
    return std::uniform_real_distribution<double>(0, 100)(random_) < percent;
  }

  void send(const Bytes& bytes) {
    ++tally_.sent;
    bus_.publish(std::string(lcm_io::kPolicyRequestChannel), bytes.data(),
                 static_cast<unsigned>(bytes.size()));
  }

  /// As a program that is started anew: another client.
  void restart(Robot& robot) {
    robot.waiting.client = static_cast<std::int64_t>(random_()) << 32 | random_();
    robot.waiting.sequence = static_cast<std::int64_t>(random_());
    robot.heard.clear();
    begin(robot);
  }
  void begin(Robot& robot) {
    robot.environment.reset(robot.seed++);
    ask(robot, true);
  }
  /// The next question, and the answer to it.
  void ask(Robot& robot, bool reset) {
    const policy::Observation seen = policy::observe(robot.environment);
    const auto progress = robot.environment.progress();
    const auto done = progress.completion();
    robot.waiting = {.client = robot.waiting.client,
                     .sequence = robot.waiting.sequence + 1 + static_cast<int>(random_() % 3),
                     .reset = reset,
                     .mission = robot.environment.mission(),
                     .image = seen.image,
                     .direction = robot.environment.direction(),
                     .completion = {done.begin(), done.end()}};
    if (reset) robot.reference.begin(0);
    robot.reference.observe(0, seen);
    robot.expected = {};
    robot.expected.value = robot.reference.decide(policy::Greedy{})[0].value;
    policy::AttentionRecord record;
    robot.reference.attention(0, record);
    const auto logits = robot.reference.logits(0);
    robot.expected.probabilities.resize(logits.size());
    nn::Categorical<float>::log_softmax(logits, robot.expected.probabilities);
    for (float& p : robot.expected.probabilities) p = std::exp(p);
    robot.expected.word_weights = record.weights;
    robot.expected.word_mask = record.mask;
    std::ranges::copy(record.gaze, robot.expected.map.begin());
    robot.expected.nowhere = record.nowhere;
    robot.times_sent = 0;
  }

  /// Sends what is due, and what disturbs.
  void act(Robot& robot) {
    const auto now = Clock::now();
    if (now < robot.next_action) return;
    if (robot.times_sent > 0 && now - robot.sent_at < std::chrono::milliseconds(20)) return;
    const Bytes bytes = lcm_io::encode(lcm_io::to_message(robot.waiting, 1));
    tally_.retries += robot.times_sent > 0;
    ++robot.times_sent;
    robot.sent_at = now;
    const bool late = chance(options_.late);
    if (late) old_.push_back(bytes);
    if (chance(options_.lost)) {
      ++tally_.lost;
    } else if (!late) {
      send(bytes);
      if (chance(options_.repeated)) {
        ++tally_.repeated;
        ++robot.times_sent;
        send(bytes);
      }
    }
    if (chance(options_.late) && !old_.empty()) {
      const std::size_t which = random_() % old_.size();
      ++tally_.late;
      send(old_[which]);
      old_.erase(old_.begin() + static_cast<std::ptrdiff_t>(which));
    }
    if (chance(options_.garbage)) send_garbage();
    if (chance(0.1)) {
      ++tally_.restarts;
      restart(robot);
    }
  }

  void send_garbage() {
    ++tally_.garbage;
    Bytes bytes;
    if (chance(50)) {
      bytes.resize(random_() % 2000);
      for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    } else {
      policy::Request request = robots_[random_() % robots_.size()].waiting;
      request.client = -1;  // nobody's
      request.reset = true;
      bytes = lcm_io::encode(lcm_io::to_message(request, 1));
      constexpr std::size_t kClient = 16 + 8;  // what stands before is not damaged
      for (int k = 0; k < 4; ++k) {
        bytes[kClient + random_() % (bytes.size() - kClient)] =
            static_cast<std::uint8_t>(random_());
      }
      if (chance(30)) bytes.resize(random_() % bytes.size());
    }
    send(bytes);
  }

  void hear(const Bytes& bytes) {
    const auto reply = lcm_io::decode<policy_reply_t>(bytes);
    for (Robot& robot : robots_) {
      if (robot.waiting.client == reply.client_id) return hear(robot, reply);
    }
  }

  void hear(Robot& robot, const policy_reply_t& reply) {
    const auto fail = [&](const char* what) {
      if (++tally_.wrong < 10) {
        fmt::print(stderr, "client {}, request {}: {}; error '{}'\n", reply.client_id, reply.seq,
                   what, reply.error);
      }
    };
    if (!reply.error.empty()) {
      const bool evicted = reply.error.find("was evicted") != std::string::npos;
      const bool late = reply.error.find("comes late") != std::string::npos;
      const bool unknown = reply.error.find("is not known") != std::string::npos;
      if (!evicted && !late && !unknown) return fail("an error that is none");
      ++(late ? tally_.told_late : tally_.evicted);
      if (reply.seq == robot.waiting.sequence) begin(robot);
      return;
    }
    const auto [first, is_new] = robot.heard.emplace(reply.seq, reply);
    if (!same(first->second, reply)) return fail("another answer under the same number");
    if (robot.heard.size() > 100) robot.heard.erase(robot.heard.begin());
    tally_.again += !is_new;
    if (reply.seq != robot.waiting.sequence) return;
    if (chance(options_.lost)) {
      ++tally_.lost;
      return;
    }
    ++tally_.answers;
    const bool right = near(reply.value, robot.expected.value) &&
                       near(reply.probabilities, robot.expected.probabilities) &&
                       near(reply.word_weights, robot.expected.word_weights) &&
                       near(reply.word_mask, robot.expected.word_mask) &&
                       near(reply.attention_map, robot.expected.map) &&
                       near(reply.nowhere, robot.expected.nowhere);
    if (!right) fail("numbers that are not those of the reference");
    if (robot.times_sent == 1) {
      tally_.latency.push_back(std::chrono::duration<double>(Clock::now() - robot.sent_at).count());
    }
    go_on(robot, reply.action);
  }

  static bool same(policy_reply_t a, policy_reply_t b) {
    a.utime = b.utime = 0;
    return lcm_io::encode(a) == lcm_io::encode(b);
  }

  /// Does what it was told, and asks what comes next.
  void go_on(Robot& robot, int action) {
    const auto step = robot.environment.step(static_cast<grid::Action>(action));
    if (step.terminated || step.truncated) {
      ++tally_.episodes;
      tally_.successes += step.reward > 0;
      begin(robot);
    } else {
      ask(robot, false);
    }
    // The last robots are slow: they are evicted now and then.
    if (robot.is_slow) {
      robot.next_action = Clock::now() + std::chrono::milliseconds(random_() % 60);
    }
  }

  void report(double seconds) {
    const Tally& t = tally_;
    fmt::print(
        "sent {} in {:.0f} s ({:.0f} / s), of them {} retries, {} repeated, {} late, {} "
        "garbage; {} more lost on their way there or back; {} robots started anew\n",
        t.sent, seconds, static_cast<double>(t.sent) / seconds, t.retries, t.repeated, t.late,
        t.garbage, t.lost, t.restarts);
    fmt::print("answers {}, again {}, told to reset {}, told of late ones {}; wrong {}\n",
               t.answers, t.again, t.evicted, t.told_late, t.wrong);
    fmt::print("episodes {}, success {:.1f} %\n", t.episodes,
               100.0 * static_cast<double>(t.successes) /
                   static_cast<double>(std::max<std::int64_t>(1, t.episodes)));
    auto latency = t.latency;
    std::ranges::sort(latency);
    const auto quantile = [&](double q) {
      if (latency.empty()) return 0.0;
      return 1e3 * latency[static_cast<std::size_t>(q * static_cast<double>(latency.size() - 1))];
    };
    fmt::print("latency with {} robots at a time: median {:.2f} ms, p99 {:.2f} ms, of {} answers\n",
               robots_.size(), quantile(0.5), quantile(0.99), latency.size());
  }

  Options options_;
  policy::TrainedAgent agent_;
  lcm::LCM bus_;
  std::mt19937 random_;
  std::deque<Robot> robots_;  // they do not move
  std::vector<Bytes> old_, replies_;
  Tally tally_;
};

int run(int argc, char** argv) {
  Options o;
  CLI::App app{"Robots that ask a running `wordgaze serve`, over a bad network.", "soak"};
  app.add_option("--checkpoint", o.checkpoint, "that of the server")->required();
  app.add_option("--lcm-url", o.url, "that of the server")->required();
  app.add_option("--env", o.env, "the robots' world");
  app.add_option("--requests", o.requests, "to be sent, all kinds together");
  app.add_option("--robots", o.robots, "at a time; the last three are slow");
  app.add_option("--server", o.server, "process of the server, whose memory may not grow");
  app.add_option("--seed", o.seed, "of what goes wrong");
  CLI11_PARSE(app, argc, argv);
  Soak soak(o);
  soak.run();
  const Tally& t = soak.tally();
  return t.wrong == 0 && t.answers > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
