#if WORDGAZE_WITH_LCM
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "programs/tiny_run.hpp"
#include "support/log_events.hpp"
#include "support/messages.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace wordgaze {
namespace {

/// Training that logs all that it can.
const std::string kTrain =
    "train --config tiny.toml --frames 64000 --set log_episodes=1 checkpoint_every=9 ";

struct LcmLog : ::testing::Test {
  Shell run;
  LcmLog() { write_tiny_config(run); }

  std::vector<LogEvent> events(const std::string& log) const {
    return events_of(run.folder() / log);
  }
  /// The log is readable to its last byte.
  void expect_whole(const std::string& log) const {
    std::size_t size = 0;
    for (const auto& e : events(log)) size += 28 + e.channel.size() + e.bytes.size();
    EXPECT_EQ(size, std::filesystem::file_size(run.folder() / log)) << log;
  }
};

/// A message without what a clock has put into it.
LogEvent timeless(LogEvent event) {
  const auto without_time = [&]<class Message>(Message message) {
    message.utime = 0;
    if constexpr (std::is_same_v<Message, metrics_t>) {
      const auto seconds = std::ranges::find(message.name, "seconds");
      message.value.at(static_cast<std::size_t>(seconds - message.name.begin())) = 0;
    }
    event.bytes = lcm_io::encode(message);
  };
  event.timestamp = 0;
  if (event.channel == "WORDGAZE_EPISODE_BEGIN") {
    without_time(lcm_io::decode<episode_begin_t>(event.bytes));
  } else if (event.channel == "WORDGAZE_WORLD") {
    without_time(lcm_io::decode<world_t>(event.bytes));
  } else if (event.channel == "WORDGAZE_PROGRESS") {
    without_time(lcm_io::decode<progress_t>(event.bytes));
  } else if (event.channel == "WORDGAZE_STEP") {
    without_time(lcm_io::decode<step_t>(event.bytes));
  } else if (event.channel == "WORDGAZE_EPISODE_END") {
    without_time(lcm_io::decode<episode_end_t>(event.bytes));
  } else {
    without_time(lcm_io::decode<metrics_t>(event.bytes));
  }
  return event;
}

// Numbers, channels and messages: a reader cannot tell that the run was killed.
TEST_F(LcmLog, IsThatOfARunNeverInterruptedAfterKills) {
  ASSERT_TRUE(succeeded(run(kTrain + "--out one/a --lcm-log one.lcmlog")));
  std::string resume;
  for (const int rows : {30, 150, 300, 450}) {
    const auto killed = run(fmt::format(
        "{}--out two/a --lcm-log two.lcmlog {} & pid=$!\n"
        "until [ -e two/a/checkpoint.safetensors ] && [ $(wc -l <two/a/metrics.csv) -gt {} ]\n"
        "do kill -0 $pid || break; done\n"
        "kill -9 $pid; wait $pid",
        kTrain, resume, rows));
    ASSERT_EQ(killed.status, 137) << killed.err;
    resume = "--resume";
    // What a full disk or the end of power leaves.
    const std::string tail = rows == 150   ? "head -c 100 one.lcmlog >>two.lcmlog"
                             : rows == 300 ? "head -c 5000 /dev/zero >>two.lcmlog"
                                           : "true";
    ASSERT_TRUE(succeeded(run(tail)));
  }
  ASSERT_TRUE(succeeded(run(kTrain + "--out two/a --lcm-log two.lcmlog --resume")));
  const auto one = events("one.lcmlog"), two = events("two.lcmlog");
  ASSERT_EQ(one.size(), two.size());
  int ended = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].channel, two[i].channel) << i;
    ASSERT_EQ(two[i].number, static_cast<std::int64_t>(i));
    ASSERT_EQ(timeless(one[i]), timeless(two[i])) << i << ' ' << one[i].channel;
    ended += one[i].channel == "WORDGAZE_EPISODE_END";
  }
  EXPECT_GT(ended, 3);
  expect_whole("two.lcmlog");
}

// The episode that is open then has its begin in the log too.
TEST_F(LcmLog, MayBeginInTheMiddleOfARun) {
  const std::string train = "train --config tiny.toml --out a --set log_episodes=1 ";
  ASSERT_TRUE(succeeded(run(train + "--frames 64")));
  ASSERT_TRUE(succeeded(run(train + "--frames 6400 --resume --lcm-log a.lcmlog")));
  std::set<std::int64_t> begun;
  for (const auto& event : events("a.lcmlog")) {
    if (event.channel == "WORDGAZE_EPISODE_BEGIN") {
      begun.insert(lcm_io::decode<episode_begin_t>(event.bytes).episode_id);
    } else if (event.channel == "WORDGAZE_STEP") {
      EXPECT_TRUE(begun.contains(lcm_io::decode<step_t>(event.bytes).episode_id));
    }
  }
  EXPECT_FALSE(begun.empty());
  expect_whole("a.lcmlog");
}

TEST_F(LcmLog, SaysWhatTheLogLacks) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --lcm-log a.lcmlog --frames 64")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --resume --frames 128")));
  const auto resumed =
      run("train --config tiny.toml --out a --resume --frames 192 --lcm-log a.lcmlog");
  ASSERT_TRUE(succeeded(resumed));
  EXPECT_TRUE(contains(resumed.err, "ends with update 1, the checkpoint is of update 2"));
}

// The last event tells of the checkpoint's own update.
TEST_F(LcmLog, GoesOnBehindATornEvent) {
  ASSERT_TRUE(
      succeeded(run("train --config tiny.toml --out a --lcm-log a.lcmlog --set "
                    "log_episodes=1 && cp -r a b && cp a.lcmlog b.lcmlog")));
  for (const int bytes : {1, 4, 30, 200, 400}) {
    run(fmt::format("rm -r a; cp -r b a; cp b.lcmlog a.lcmlog; truncate -s -{} a.lcmlog", bytes));
    ASSERT_TRUE(
        succeeded(run("train --config tiny.toml --out a --lcm-log a.lcmlog --set "
                      "log_episodes=1 --resume --frames 256")));
    const auto after = events("a.lcmlog");
    expect_whole("a.lcmlog");
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(after[i].number, static_cast<std::int64_t>(i));
    }
    EXPECT_EQ(lcm_io::decode<metrics_t>(after.back().bytes).frames, 256);
  }
}

TEST_F(LcmLog, IsNeverGarbageThatWasAppendedTo) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a --lcm-log a.lcmlog")));
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out b")));
  for (const std::string garbage :
       {"echo 'Two roads diverged in a yellow wood' >g", "head -c 3000 /dev/zero >g",
        "head -c 3000 /dev/urandom >g", "cp a/checkpoint.safetensors g"}) {
    run(garbage + "; cp g kept");
    EXPECT_TRUE(refused(run("train --config tiny.toml --out a --resume --frames 256 --lcm-log g"),
                        "'g' holds no event of LCM"))
        << garbage;
    EXPECT_TRUE(refused(run("train --config tiny.toml --out c --lcm-log g"), "'g'")) << garbage;
    EXPECT_TRUE(succeeded(run("cmp g kept"))) << garbage;
  }
  EXPECT_TRUE(
      refused(run("train --config tiny.toml --out b --resume --frames 256 --lcm-log a.lcmlog"),
              "'a.lcmlog'", "of run 'a-1', this one is 'b-1'"));
  EXPECT_TRUE(
      refused(run("cp a/checkpoint.safetensors w; eval --checkpoint w --lcm-log w"), "'w'"));
  EXPECT_TRUE(succeeded(run("cmp a/checkpoint.safetensors w")));
}

TEST_F(LcmLog, OnAFullDiskEndsAndTrainingGoesOn) {
  // No file may grow beyond 300 kB: the checkpoint fits, the log does not.
  const auto trained = run("trap '' XFSZ; ulimit -f 300; " + kTrain + "--out a --lcm-log a.lcmlog");
  ASSERT_TRUE(succeeded(trained));
  const std::string warning = "cannot write the LCM log 'a.lcmlog': File too large";
  const auto first = trained.err.find(warning);
  ASSERT_NE(first, std::string::npos) << trained.err;
  EXPECT_EQ(trained.err.find(warning, first + 1), std::string::npos) << trained.err;
  EXPECT_TRUE(contains(trained.err, "messages are missing at the end of the log"));
  EXPECT_TRUE(run.has("a/checkpoint.safetensors"));
  EXPECT_TRUE(succeeded(run("test $(wc -l <a/metrics.csv) = 1001")));
  EXPECT_GT(events("a.lcmlog").size(), 10u);
  expect_whole("a.lcmlog");
}

TEST_F(LcmLog, OnADeviceThatIsFullEndsAndTrainingGoesOn) {
  const auto trained = run("train --config tiny.toml --out a --lcm-log /dev/full");
  ASSERT_TRUE(succeeded(trained));
  EXPECT_TRUE(contains(trained.err, "'/dev/full': No space left on device"));
  EXPECT_TRUE(run.has("a/checkpoint.safetensors"));
}

TEST_F(LcmLog, MayLieInTheFolderOfItsRun) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out c/d --lcm-log c/d/c.lcmlog")));
  EXPECT_GT(events("c/d/c.lcmlog").size(), 0u);
}

TEST_F(LcmLog, NamesTheRunAfterItsFolder) {
  for (const std::string out : {"b", "b/", "b//", "./b/.", "b/../b/", "\"$PWD/b/\""}) {
    ASSERT_TRUE(succeeded(run("rm -rf b; train --config tiny.toml --lcm-log l --out " + out)));
    for (const auto& event : events("l")) {
      if (event.channel != "WORDGAZE_METRICS") continue;
      EXPECT_EQ(lcm_io::decode<metrics_t>(event.bytes).run_id, "b-1") << out;
    }
  }
  ASSERT_TRUE(succeeded(
      run("rm -rf b; mkdir b; cd b; train --config ../tiny.toml --lcm-log ../l --out .")));
  EXPECT_EQ(lcm_io::decode<metrics_t>(events("l").back().bytes).run_id, "b-1");
}

TEST_F(LcmLog, IsForOneProcess) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  const auto second = run(
      "exec 3>l; flock -x 3; eval --checkpoint a/checkpoint.safetensors --episodes 1 --lcm-log l");
  EXPECT_TRUE(refused(second, "'l'", "another process is writing it"));
}

TEST_F(LcmLog, OfAnEvaluationTellsSettingsAndPoliciesApart) {
  ASSERT_TRUE(succeeded(run("train --config tiny.toml --out a")));
  ASSERT_TRUE(
      succeeded(run("eval --checkpoint a/checkpoint.safetensors --episodes 3 --rooms 6,8 "
                    "--lcm-log e.lcmlog")));
  std::set<std::int64_t> ids, ended;
  std::vector<std::string> runs;
  for (const auto& event : events("e.lcmlog")) {
    if (event.channel == "WORDGAZE_EPISODE_BEGIN") {
      const auto begin = lcm_io::decode<episode_begin_t>(event.bytes);
      EXPECT_TRUE(ids.insert(begin.episode_id).second) << begin.episode_id;
      EXPECT_EQ(begin.seed, 1'000'000 + begin.episode_id % 3);
      EXPECT_EQ(begin.checkpoint, "a/checkpoint.safetensors");
      EXPECT_TRUE(contains(begin.env_id, begin.episode_id < 6 ? "N6" : "N8"));
      if (runs.empty() || runs.back() != begin.run_id) runs.push_back(begin.run_id);
    } else if (event.channel == "WORDGAZE_STEP") {
      EXPECT_TRUE(ids.contains(lcm_io::decode<step_t>(event.bytes).episode_id));
    } else if (event.channel == "WORDGAZE_WORLD") {
      EXPECT_TRUE(ids.contains(lcm_io::decode<world_t>(event.bytes).episode_id));
    } else if (event.channel == "WORDGAZE_PROGRESS") {
      EXPECT_TRUE(ids.contains(lcm_io::decode<progress_t>(event.bytes).episode_id));
    } else {
      ended.insert(lcm_io::decode<episode_end_t>(event.bytes).episode_id);
    }
  }
  EXPECT_EQ(ids.size(), 12u);
  EXPECT_EQ(*ids.rbegin(), 11);
  EXPECT_EQ(ended, ids);
  EXPECT_EQ(runs, (std::vector<std::string>{"eval-1-sampled", "eval-2-greedy", "eval-3-sampled",
                                            "eval-4-greedy"}));
}

TEST_F(LcmLog, AndLiveViewAreRefusedWhereTheyMeanNothing) {
  for (const auto& [url, why] : std::vector<std::pair<std::string, std::string>>{
           {"udpm://?ttl=abc", "expected a ttl"},
           {"udpm://?tll=1", "unknown parameter 'tll'"},
           {"udpm://127.0.0.1:7667", "224.0.0.0 to 239.255.255.255"},
           {"file://x", "expected udpm://"},
           {"memq://", "expected udpm://"},
           {"tcpq://localhost:7700", "tcpq is not offered"},
           {"", "--lcm-url"}}) {
    const auto started =
        run("train --config tiny.toml --out a --lcm-log a.lcmlog --lcm-url '" + url + "'");
    EXPECT_TRUE(refused(started, why)) << url;
    EXPECT_LT(started.err.size(), 500u) << url;
    EXPECT_FALSE(run.has("a.lcmlog")) << url;
  }
  EXPECT_TRUE(refused(run("train --config tiny.toml --out a --lcm-log \"$UNSET\""), "--lcm-log"));
}

}  // namespace
}  // namespace wordgaze
#endif
