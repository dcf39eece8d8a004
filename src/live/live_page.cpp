#include "wordgaze/page/live_page.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "event_stream.hpp"
#include "page/episode_json.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::page {
namespace {

constexpr std::size_t kEventsKept = 4000;  // some megabytes
constexpr std::size_t kCommandsKept = 100;
constexpr std::size_t kLongestCommand = 4096;  // bytes
constexpr int kListeners = 8;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// By number or by its one name: "127.somewhere" is a name of somebody else's.
bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" ||
         (address.starts_with("127.") &&
          address.find_first_not_of("0123456789.") == std::string::npos);
}

}  // namespace

struct LivePage::Server {
  explicit Server(Options given) : options(std::move(given)) {
    require(options.every > 0, "LivePage: every {}-th episode; expected 1 or more", options.every);
    http.new_task_queue = [] { return new httplib::ThreadPool(kListeners + 4); };
    http.set_payload_max_length(kLongestCommand);
    http.set_read_timeout(5);
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& reply) {
      return is_of_ours(request) ? httplib::Server::HandlerResponse::Unhandled
                                 : refuse(reply, "this page answers under its own name only");
    });
    http.Get("/", [this](const httplib::Request&, httplib::Response& reply) {
      reply.set_content(
          page_with(options.title,
                    {{"episodes", Json::array()}, {"live", true}, {"commands", options.commands}}),
          "text/html; charset=utf-8");
    });
    http.Get("/events",
             [this](const httplib::Request&, httplib::Response& reply) { stream(reply); });
    if (options.commands) {
      http.Post("/command", [this](const httplib::Request& request, httplib::Response& reply) {
        // A page of another site cannot send this type without asking first, and is not answered.
        if (request.get_header_value("Content-Type") != "application/json") {
          refuse(reply, "commands are application/json");
        } else if (!commands.add(request.body)) {
          reply.status = 429;
        }
      });
    }
    const bool bound = options.port != 0
                           ? http.bind_to_port(options.address, options.port)
                           : (options.port = http.bind_to_any_port(options.address)) > 0;
    if (!bound) {
      throw std::runtime_error(fmt::format(
          "cannot listen on {} port {}: it is taken, or not an address of this machine; "
          "give another with --watch-address and --watch-port",
          options.address, options.port));
    }
    thread = std::thread([this] { http.listen_after_bind(); });
    // stop() does nothing before it runs.
    while (!http.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  ~Server() {
    events.close();
    http.stop();
    thread.join();
  }

  /// On loopback, only under a name of loopback: a foreign name that has been pointed at this
  /// machine is some other site's.
  bool is_of_ours(const httplib::Request& request) const {
    if (!is_loopback(options.address)) return true;
    std::string host = request.get_header_value("Host");
    host.resize(std::min(host.size(), host.rfind(':')));  // without its port
    return is_loopback(host) || host == "[::1]";
  }
  static httplib::Server::HandlerResponse refuse(httplib::Response& reply, const char* why) {
    reply.status = 403;
    reply.set_content(why, "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  }

  /// Server-sent events, until the reader goes or the page ends.
  void stream(httplib::Response& reply) {
    if (listening.fetch_add(1) >= kListeners) {
      --listening;
      reply.status = 503;
      return;
    }
    reply.set_header("Cache-Control", "no-store");
    reply.set_chunked_content_provider(
        "text/event-stream",
        [this, place = std::uint64_t{0}](std::size_t, httplib::DataSink& sink) mutable {
          const auto event = events.next(place);
          if (events.closed()) {
            sink.done();
            return true;
          }
          const std::string text = event ? "data: " + *event + "\n\n" : ": still here\n\n";
          return sink.write(text.data(), text.size());
        },
        [this](bool) { --listening; });
  }

  void tell(std::int64_t episode, const char* what, Json told) {
    events.add(text_of({{"episode", episode}, {what, std::move(told)}}));
  }

  /// What readers send, in order; those who send too much are not heard.
  class Commands {
   public:
    bool add(std::string command) {
      {
        const std::scoped_lock lock(mutex_);
        if (commands_.size() >= kCommandsKept) return false;
        commands_.push_back(std::move(command));
      }
      arrived_.notify_one();
      return true;
    }
    std::optional<std::string> next(std::chrono::milliseconds wait) {
      std::unique_lock lock(mutex_);
      if (!arrived_.wait_for(lock, wait, [this] { return !commands_.empty(); }))
        return std::nullopt;
      std::string first = std::move(commands_.front());
      commands_.pop_front();
      return first;
    }

   private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<std::string> commands_;
  };

  Options options;
  EpisodeJson json;
  EventStream events{kEventsKept};
  Commands commands;
  std::atomic<int> listening{0};
  httplib::Server http;
  std::thread thread;
};

LivePage::LivePage(Options options) : server_(std::make_unique<Server>(std::move(options))) {}

LivePage::~LivePage() = default;

std::string LivePage::url() const {
  return fmt::format("http://{}:{}/", server_->options.address, server_->options.port);
}

std::optional<std::string> LivePage::next_command(std::chrono::milliseconds wait) {
  return server_->commands.next(wait);
}

void LivePage::preview(const policy::StepRecord& step) {
  auto json = server_->json.step(step);
  if (!json) return;
  (*json)["pending"] = true;
  server_->tell(step.episode, "step", *std::move(json));
}

void LivePage::note(std::string_view text) { server_->events.add(text_of({{"note", text}})); }

void LivePage::on_run(std::string_view run_id) { server_->json.on_run(run_id); }

bool LivePage::wants_episode(std::int64_t episode) { return episode % server_->options.every == 0; }

void LivePage::on_begin(const policy::EpisodeBegin& begin) {
  if (!wants_episode(begin.episode)) return;
  server_->tell(begin.episode, "begin", server_->json.begin(begin));
}

void LivePage::on_decision(const evaluation::DecisionContext& context) {
  server_->json.decision(context);
}

void LivePage::on_scene(const policy::SceneRecord& scene) { server_->json.scene(scene); }

void LivePage::on_step(const policy::StepRecord& step) {
  auto json = server_->json.step(step);
  if (!json) return;
  server_->tell(step.episode, "step", *std::move(json));
}

void LivePage::on_end(const policy::EpisodeEnd& end) {
  if (auto json = server_->json.end(end)) server_->tell(end.episode, "end", *std::move(json));
}

void LivePage::on_update(const policy::UpdateRecord& update) {
  Json scalars = Json::object();
  for (const policy::Scalar& scalar : update.scalars) {
    scalars[std::string(scalar.name)] =
        std::isfinite(scalar.value) ? Json(scalar.value) : Json(nullptr);
  }
  server_->events.add(
      text_of({{"update", update.update}, {"frames", update.frames}, {"scalars", scalars}}));
}

}  // namespace wordgaze::page
