#include "wordgaze/page/live_page.hpp"

#include <gtest/gtest.h>

#if WORDGAZE_WITH_HTTP
#include <httplib.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "live/event_stream.hpp"
#include "support/messages.hpp"

namespace wordgaze::page {
namespace {

using namespace std::chrono_literals;

httplib::Client client_of(const LivePage& live) {
  const std::string url = live.url();
  httplib::Client client(url.substr(0, url.size() - 1));
  client.set_read_timeout(5);
  return client;
}

void tell_episode(LivePage& live, std::int64_t id) {
  const babyai::Sentence sentence = babyai::sentence_of("go to the red ball");
  const std::array<std::uint8_t, grid::kImageBytes> image{};
  live.on_begin({.episode = id, .env_id = "e", .sentence = sentence, .mission = "m"});
  live.on_step({.episode = id, .step = 0, .image = image});
  live.on_end({.episode = id, .success = true});
}

/// The first so many events that a reader gets.
std::vector<nlohmann::json> events_of(const LivePage& live, std::size_t count) {
  std::vector<nlohmann::json> events;
  std::string text;
  auto client = client_of(live);
  client.Get("/events", [&](const char* data, std::size_t size) {
    text.append(data, size);
    for (std::size_t end = 0; (end = text.find("\n\n")) != text.npos; text.erase(0, end + 2)) {
      if (text.starts_with("data: ")) {
        events.push_back(nlohmann::json::parse(text.substr(6, end - 6)));
      }
    }
    return events.size() < count;
  });
  return events;
}

TEST(LivePage, ShowsAPageAndTellsWhatHappens) {
  LivePage live({.title = "now"});
  EXPECT_TRUE(contains(live.url(), "http://127.0.0.1:"));
  const auto page = client_of(live).Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_TRUE(contains(page->body, "<title>now</title>"));
  EXPECT_TRUE(contains(page->body, "\"live\":true"));
  live.on_run("r");
  tell_episode(live, 4);
  live.note("over");
  const std::array<policy::Scalar, 1> scalars{{{"success_rate", 0.5}}};
  live.on_update({.update = 3, .frames = 100, .scalars = scalars});
  const auto events = events_of(live, 5);  // a reader who comes late hears them, too
  ASSERT_EQ(events.size(), 5u);
  EXPECT_EQ(events[0]["begin"]["mission"], "m");
  EXPECT_EQ(events[0]["begin"]["run"], "r");
  EXPECT_EQ(events[1]["episode"], 4);
  EXPECT_EQ(events[1]["step"]["step"], 0);
  EXPECT_EQ(events[2]["end"]["success"], true);
  EXPECT_EQ(events[3]["note"], "over");
  EXPECT_EQ(events[4]["scalars"]["success_rate"], 0.5);
}

TEST(LivePage, TellsOnlyEveryKthEpisode) {
  LivePage live({.title = "now", .every = 10});
  for (const int id : {0, 1, 9, 10}) {
    EXPECT_EQ(live.wants_episode(id), id % 10 == 0);
    tell_episode(live, id);
  }
  const auto events = events_of(live, 6);
  EXPECT_EQ(events[0]["episode"], 0);
  EXPECT_EQ(events[3]["episode"], 10);
}

TEST(LivePage, TakesCommandsFromItsOwnPageAlone) {
  LivePage closed({.title = "now"}), open({.title = "now", .commands = true});
  const auto post = [](const LivePage& live, const std::string& text, const char* type) {
    const auto reply = client_of(live).Post("/command", text, type);
    return reply ? reply->status : -1;
  };
  EXPECT_EQ(post(closed, "{}", "application/json"), 404);
  EXPECT_EQ(post(open, "{}", "text/plain"), 403);  // what a form of another site can send
  EXPECT_FALSE(open.next_command(0ms));
  EXPECT_EQ(post(open, "{\"next\":1}", "application/json"), 200);
  EXPECT_EQ(open.next_command(1s), "{\"next\":1}");
  EXPECT_EQ(post(open, std::string(5000, 'x'), "application/json"), 413);
  int last = 200;
  for (int i = 0; i < 200 && last == 200; ++i) last = post(open, "{}", "application/json");
  EXPECT_EQ(last, 429);  // nobody obeys: what waits is bounded
}

// A foreign site may point its own name at this machine to be let in as ours.
TEST(LivePage, AnswersUnderItsOwnNameOnly) {
  LivePage live({.title = "now"});
  const auto status = [&](const std::string& host) {
    const auto reply = client_of(live).Get("/", {{"Host", host}});
    return reply ? reply->status : -1;
  };
  EXPECT_EQ(status("localhost:80"), 200);
  EXPECT_EQ(status("127.0.0.1"), 200);
  EXPECT_EQ(status("evil.example"), 403);
  EXPECT_EQ(status("127.evil.example:80"), 403);
}

TEST(LivePage, EndsWhileReadersListen) {
  auto live = std::make_unique<LivePage>(LivePage::Options{.title = "now"});
  std::atomic<bool> heard{false};
  std::thread reader([&, url = live->url()] {
    httplib::Client client(url.substr(0, url.size() - 1));
    client.Get("/events", [&](const char*, std::size_t) { return heard = true; });
  });
  live->note("hello");
  while (!heard) std::this_thread::sleep_for(1ms);
  live.reset();
  reader.join();
}

TEST(LivePage, SaysWhyItCannotListen) {
  LivePage first({.title = "now"});
  const int port = std::stoi(first.url().substr(first.url().rfind(':') + 1));
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] {
                         LivePage second({.title = "now", .address = "192.0.2.1", .port = port});
                       }),
                       "cannot listen on 192.0.2.1"));
}

TEST(EventStream, KeepsTheLastOnes) {
  EventStream stream(3);
  for (const char* text : {"a", "b", "c", "d", "e"}) stream.add(text);
  std::uint64_t place = 0;
  EXPECT_EQ(stream.next(place), "c");
  EXPECT_EQ(stream.next(place), "d");
  EXPECT_EQ(stream.next(place), "e");
  stream.close();
  EXPECT_FALSE(stream.next(place));
}

}  // namespace
}  // namespace wordgaze::page
#endif
