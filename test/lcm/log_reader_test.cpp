#include "wordgaze/lcm/log_reader.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "lcm/event_log.hpp"
#include "lcm/example_records.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/log_writer.hpp"

namespace wordgaze::lcm_io {
namespace {

/// Writes down what it hears.
class Notes final : public policy::Observer {
 public:
  std::vector<std::string> heard;
  std::vector<float> maps;
  float nowhere = -1;
  policy::SceneRecord scene{};
  std::vector<std::uint8_t> cells;

  void on_run(std::string_view run) override { heard.push_back("run " + std::string(run)); }
  bool wants_episode(std::int64_t episode) override { return episode != 99; }
  bool wants_scenes() const override { return true; }
  void on_begin(const policy::EpisodeBegin& r) override {
    heard.push_back(formatted("begin {} {}", r.episode, babyai::text(r.sentence)));
  }
  void on_scene(const policy::SceneRecord& r) override {
    heard.push_back(formatted("scene {} {}", r.episode, r.step));
    scene = r;
    cells.assign(r.cells.begin(), r.cells.end());
    EXPECT_EQ(r.targets.size(), 2u);
    EXPECT_EQ(r.completion.size(), 2u);
    EXPECT_EQ(r.sub_task_of.size(), 5u);
  }
  void on_step(const policy::StepRecord& r) override {
    heard.push_back(formatted("step {} {}", r.episode, r.step));
    maps.assign(r.word_attention.begin(), r.word_attention.end());
    nowhere = r.nowhere;
  }
  void on_end(const policy::EpisodeEnd& r) override {
    heard.push_back(formatted("end {}", r.episode));
  }
  void on_update(const policy::UpdateRecord& r) override {
    heard.push_back(formatted("update {} {}", r.update, r.scalars.size()));
  }
};

void play(policy::Observer& observer, std::int64_t episode) {
  const ExampleRecords records;
  observer.on_begin(records.begin(episode));
  observer.on_scene(records.scene(episode, 0));
  observer.on_step(records.step(episode, 0));
  observer.on_end(records.end(episode));
}

TEST(LogReader, TellsWhatTheWriterWasTold) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  {
    LogWriter writer(folder / "a", {"run 1", ""});
    play(writer, 4);
    writer.on_update(records.update(7));
    writer.on_run("run 2");
    play(writer, 5);
    play(writer, 99);
  }
  Notes notes;
  const LogSummary summary = replay_log(folder / "a", notes);
  EXPECT_EQ(notes.heard, (std::vector<std::string>{"run run 1", "begin 4 pick up the blue key",
                                                   "scene 4 0", "step 4 0", "end 4", "update 7 2",
                                                   "run run 2", "begin 5 pick up the blue key",
                                                   "scene 5 0", "step 5 0", "end 5"}));
  EXPECT_EQ(notes.maps, records.attention);
  EXPECT_EQ(notes.cells, std::vector<std::uint8_t>(records.cells.begin(), records.cells.end()));
  EXPECT_EQ(notes.scene.width, 3);
  EXPECT_EQ(notes.scene.carried, (std::array<std::uint8_t, 3>{5, 2, 0}));
  EXPECT_EQ(notes.nowhere, 0);  // the maps of the words sum to 1: nothing is left for nowhere
  EXPECT_EQ(summary.episodes, 3);
  EXPECT_EQ(summary.messages, summary.events);
  EXPECT_EQ(summary.refused + summary.orphans, 0);
  EXPECT_EQ(summary.unread, 0u);
}

TEST(LogReader, LeavesOutWhatIsLostTornOrOfOthers) {
  const TemporaryFolder folder;
  const ExampleRecords records;
  {
    EventLog log(folder / "a");
    const auto step = encode(to_message(records.step(3, 0), 1));
    log.append(0, 1, "WORDGAZE_STEP", step);  // its episode began before
    log.append(1, 1, "WORDGAZE_WORLD", std::vector<std::uint8_t>{1, 2, 3});
    log.append(2, 1, "POSE", std::vector<std::uint8_t>{1, 2, 3});
    auto begin = to_message(records.begin(4), {}, 1);
    log.append(3, 1, "WORDGAZE_EPISODE_BEGIN", encode(begin));
    begin.token_ids[2] = 4000;
    log.append(4, 1, "WORDGAZE_EPISODE_BEGIN", encode(begin));
    auto other = to_message(records.step(4, 0), 1);
    other.action = 7;
    log.append(5, 1, "WORDGAZE_STEP", encode(other));
    log.append(6, 1, "WORDGAZE_STEP", encode(to_message(records.step(4, 0), 1)));
  }
  std::ofstream(folder / "a", std::ios::app) << "\xED\xA1";
  Notes notes;
  const LogSummary summary = replay_log(folder / "a", notes);
  EXPECT_EQ(notes.heard,
            (std::vector<std::string>{"run ", "begin 4 pick up the blue key", "step 4 0"}));
  EXPECT_EQ(summary.events, 7);
  EXPECT_EQ(summary.orphans, 1);
  EXPECT_EQ(summary.refused, 3);
  EXPECT_EQ(summary.unread, 2u);
}

TEST(LogReader, RefusesWhatIsNoLog) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "no log";
  Notes notes;
  const auto refusal = [&](const std::filesystem::path& path) {
    return message_of<std::runtime_error>([&] { replay_log(path, notes); });
  };
  EXPECT_TRUE(contains(refusal(folder / "a"), "holds no event of LCM"));
  EXPECT_TRUE(contains(refusal(folder / "none"), "No such file"));
  EXPECT_TRUE(contains(refusal(folder / "."), "not a file"));
}

TEST(LogReader, SurvivesFlippedBits) {
  const TemporaryFolder folder;
  {
    LogWriter writer(folder / "a", {"run 1", ""});
    play(writer, 4);
    play(writer, 5);
  }
  const std::string whole = io::read_file(folder / "a");
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    std::ofstream(folder / "b", std::ios::binary) << damaged;  // no need to reach the disk
    policy::Observer nobody;
    try {
      const LogSummary summary = replay_log(folder / "b", nobody);
      EXPECT_LE(summary.messages + summary.refused, 10);
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace wordgaze::lcm_io
