// page: a page to look at the episodes of an LCM log with.
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "command.hpp"
#include "output.hpp"
#include "wordgaze/io/output_check.hpp"
#include "wordgaze/page/episode_page.hpp"
#if WORDGAZE_WITH_LCM
#include "wordgaze/lcm/log_reader.hpp"
#endif

namespace {

using namespace wordgaze;

struct Arguments {
  std::string log, out;
  int episodes = 200;
};

#if WORDGAZE_WITH_LCM
int run(const Arguments& a) {
  io::check_outputs(std::array{io::NamedPath{"--out", a.out}},
                    std::array{io::NamedPath{"--log", a.log}});
  page::EpisodePage page(std::filesystem::path(a.log).filename().string(), a.episodes);
  const lcm_io::LogSummary log = lcm_io::replay_log(a.log, page);
  if (page.episodes() == 0) {
    throw std::runtime_error(fmt::format(
        "'{}' holds {} events and no beginning of an episode: nothing to show", a.log, log.events));
  }
  page.write(a.out);
  apps::say("{} of {} episodes to look at in {}\n", page.episodes(), log.episodes, a.out);
  const auto left_out = [](auto count, const char* what) {
    if (count > 0) apps::say("left out: {} {}\n", count, what);
  };
  left_out(log.refused, "messages that are not valid");
  left_out(log.orphans, "messages of episodes that begin before the log");
  left_out(log.unread, "bytes behind the last whole event");
  return 0;
}
#else
int run(const Arguments&) {
  throw std::invalid_argument(
      "this program was built without LCM; install liblcm-dev and configure with "
      "-DWORDGAZE_WITH_LCM=ON");
}
#endif

}  // namespace

wordgaze::apps::Command wordgaze::apps::page_command() {
  return {
      "page",
      "Makes a page (HTML) from an LCM log, of --lcm-log or of lcm-logger: open it in a browser.\n"
      "For an agent at hand, eval --page shows more: what it would do without a cell or a word.",
      [](CLI::App& app) {
        const auto a = std::make_shared<Arguments>();
        app.add_option("--log", a->log, "LCM log")->required();
        app.add_option("--out", a->out, "file of the page")->required();
        app.add_option("--episodes", a->episodes, "at most so many of each run, the first ones")
            ->check(apps::whole_number(1, 100'000));
        return [a] { return run(*a); };
      }};
}
