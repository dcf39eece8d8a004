// serve: an agent that answers robots over LCM.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "chosen_level.hpp"
#include "command.hpp"
#if WORDGAZE_WITH_LCM
#include <fmt/format.h>

#include <chrono>

#include "output.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/io/progress.hpp"
#include "wordgaze/io/stop_signals.hpp"
#include "wordgaze/lcm/origin.hpp"
#include "wordgaze/lcm/policy_service.hpp"
#include "wordgaze/policy/environment.hpp"
#include "wordgaze/policy/server.hpp"
#include "wordgaze/training/checkpoint.hpp"
#endif

namespace {

using namespace wordgaze;

struct Arguments {
  std::string checkpoint, env, level, url = "udpm://239.255.76.67:7667?ttl=0";
  std::size_t clients = 64;
  bool greedy = false, sample = false;
  std::uint64_t seed = 1;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--checkpoint", a.checkpoint, "the agent: file that train has written")
      ->required();
  app.add_option("--env", a.env,
                 "level whose cells robots may show, in place of the one trained in");
  app.add_option("--level", a.level, "the same, of a file: docs/own-level.md");
  app.add_option("--lcm-url", a.url, "where robots ask, udpm://[group[:port]][?ttl=n]")
      ->capture_default_str();
  app.add_option("--clients", a.clients,
                 "robots with a memory at a time; another one takes the place of the one that was "
                 "silent the longest")
      ->check(apps::whole_number<std::size_t>(1, 100'000))
      ->capture_default_str();
  auto* greedy = app.add_flag("--greedy", a.greedy, "the likeliest action");
  app.add_flag("--sample", a.sample, "actions drawn from the policy; the default")
      ->excludes(greedy);
  app.add_option("--seed", a.seed, "of the draws")
      ->check(apps::whole_number<std::uint64_t>(0))
      ->capture_default_str();
}

#if WORDGAZE_WITH_LCM

std::string summary(const policy::Server::Counts& server,
                    const lcm_io::PolicyService::Counts& service) {
  return fmt::format(
      "{} requests ({} repeats), {} errors, {} clients, {} evictions, {} messages that were no "
      "requests, {} answers not sent",
      server.requests, server.repeats, server.errors, server.clients, server.evictions,
      service.foreign, service.unsent);
}

int run(const Arguments& a) {
  const io::StopSignals signals("\nserve: stopping; again to stop at once\n");
  const auto config = training::load_config(a.checkpoint);
  const auto level = apps::chosen_level(a.level, a.env, config.env, config.level);
  // As in evaluations: what a word says of a cell depends on which others there could be.
  const auto trained = policy::TrainedAgent::load(a.checkpoint, policy::alphabet_of(level));
  policy::NetworkPolicy agent(trained);
  policy::Server server(agent, {.clients = a.clients, .greedy = a.greedy, .seed = a.seed});
  lcm_io::PolicyService service(a.url, server);
  apps::say("serve: {} listens on {}, {}, and answers on {}: {}, up to {} clients\n", a.checkpoint,
            a.url, lcm_io::kPolicyRequestChannel, lcm_io::kPolicyReplyChannel,
            a.greedy ? "likeliest actions" : fmt::format("drawn actions, seed {}", a.seed),
            a.clients);
  {
    io::Progress progress("requests", 0, 0, {.terminal_interval_s = 1});
    bool complained = false;
    while (io::StopSignals::received() == 0) {
      service.serve(std::chrono::milliseconds(100));
      const auto& counts = server.counts();
      if (!complained && !service.complaint().empty()) {
        apps::note("serve: a message on {} is passed over: {}\n", lcm_io::kPolicyRequestChannel,
                   service.complaint());
        complained = true;
      }
      progress.update(counts.requests,
                      fmt::format("{} clients, {} errors, {} evictions", server.clients(),
                                  counts.errors, counts.evictions));
    }
  }
  apps::say("serve: {}\n", summary(server.counts(), service.counts()));
  io::StopSignals::check();
  return 0;
}

#else

int run(const Arguments&) {
  throw std::invalid_argument(
      "serve: this program was built without LCM; install liblcm-dev and configure with "
      "-DWORDGAZE_WITH_LCM=ON");
}

#endif

}  // namespace

wordgaze::apps::Command wordgaze::apps::serve_command() {
  return {
      "serve",
      "Lets a trained agent act for robots: answers policy_request_t over LCM by "
      "policy_reply_t\n(docs/robot-server.md), until a signal stops it. Without --greedy actions "
      "are drawn from the policy.",
      [](CLI::App& app) {
        const auto arguments = std::make_shared<Arguments>();
        add_options(app, *arguments);
        return [arguments] { return run(*arguments); };
      }};
}
