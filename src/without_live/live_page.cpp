// What stands in for the live page where the library was built without a server of HTTP.
#include "wordgaze/page/live_page.hpp"

#include <stdexcept>

namespace wordgaze::page {

struct LivePage::Server {};

LivePage::LivePage(Options) {
  throw std::invalid_argument(
      "built without the live page; install libcpp-httplib-dev and configure with "
      "-DWORDGAZE_WITH_HTTP=ON");
}
LivePage::~LivePage() = default;
std::string LivePage::url() const { return {}; }
std::optional<std::string> LivePage::next_command(std::chrono::milliseconds) { return {}; }
void LivePage::preview(const policy::StepRecord&) {}
void LivePage::note(std::string_view) {}
void LivePage::on_run(std::string_view) {}
bool LivePage::wants_episode(std::int64_t) { return false; }
void LivePage::on_begin(const policy::EpisodeBegin&) {}
void LivePage::on_decision(const evaluation::DecisionContext&) {}
void LivePage::on_scene(const policy::SceneRecord&) {}
void LivePage::on_step(const policy::StepRecord&) {}
void LivePage::on_end(const policy::EpisodeEnd&) {}
void LivePage::on_update(const policy::UpdateRecord&) {}

}  // namespace wordgaze::page
