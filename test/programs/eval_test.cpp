#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"
#if WORDGAZE_WITH_LCM
#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <map>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/lcm/decode.hpp"
#endif

namespace wordgaze {
namespace {

#if WORDGAZE_WITH_LCM
template <class Message>
Message decoded(const lcm::LogEvent& event) {
  return lcm_io::decode<Message>(
      {static_cast<const std::uint8_t*>(event.data), static_cast<std::size_t>(event.datalen)});
}
#endif

/// One trained agent for all tests: ckpt in the folder.
struct Eval : ::testing::Test {
  Shell run;
  Eval() {
    write_tiny_config(run);
    run("train --config tiny.toml --out a && mv a/checkpoint.safetensors ckpt");
  }
};

TEST_F(Eval, ReportsEverySetting) {
  const Shell::Result evaluated =
      run("eval --checkpoint ckpt --rooms 6,8 --objects 2,4 --episodes 10 --json e.json");
  ASSERT_TRUE(succeeded(evaluated));
  EXPECT_TRUE(contains(evaluated.out, "Wordgaze-One-N6-K2-v0"));
  const auto report = nlohmann::json::parse(run.read("e.json"));
  EXPECT_EQ(report.at("checkpoint"), "ckpt");
  ASSERT_EQ(report.at("settings").size(), 2u * 2u * 2u);
  for (const auto& setting : report["settings"]) {
    EXPECT_EQ(setting.at("episodes"), 10);
    EXPECT_TRUE(setting.at("policy") == "greedy" || setting.at("policy") == "sampled");
    EXPECT_LE(setting.at("success_ci95")[0], setting.at("success_rate"));
    EXPECT_GE(setting.at("success_ci95")[1], setting.at("success_rate"));
    const double successes = setting.at("success_rate").get<double>() * 10;
    EXPECT_NEAR(
        successes + setting.at("done_wrong").get<int>() + setting.at("truncated").get<int>(), 10,
        1e-9);
    for (const char* key : {"env", "room", "objects", "mean_reward", "mean_steps"}) {
      EXPECT_TRUE(setting.contains(key)) << key;
    }
  }
}

TEST_F(Eval, ChangesRoomsAndObjectsOfEveryLevelThatHasThem) {
  const Shell::Result evaluated =
      run("eval --checkpoint ckpt --env BabyAI-GoToLocal-v0 --rooms 6,10 --objects 3 --episodes 5 "
          "--greedy --json e.json");
  ASSERT_TRUE(succeeded(evaluated));
  const auto report = nlohmann::json::parse(run.read("e.json"));
  ASSERT_EQ(report.at("settings").size(), 2u);
  EXPECT_EQ(report["settings"][1].at("room"), 10);
  EXPECT_EQ(report["settings"][1].at("objects"), 3);
}

/// The first row of a model's card: environment, policy and success in percent.
std::smatch first_row(const std::string& card) {
  static const std::regex row(
      R"(\| ((?:Wordgaze|BabyAI)-\S+) \| (sampled|greedy) \| \d+ \| ([\d.]+) % )");
  std::smatch match;
  EXPECT_TRUE(std::regex_search(card, match, row)) << card;
  return match;
}

TEST(Models, DoWhatTheirCardsSay) {
  const Shell run;
  int models = 0;
  for (const auto& file : std::filesystem::directory_iterator(WORDGAZE_SOURCE_DIR "/models")) {
    if (file.path().extension() != ".safetensors") continue;
    ++models;
    const auto card = run.read(std::filesystem::path(file).replace_extension("md"));
    const auto row = first_row(card);
    ASSERT_EQ(row.size(), 4u);
    ASSERT_TRUE(succeeded(run(fmt::format(
        "eval --checkpoint '{}' --env {} --{} --episodes 300 --json e.json", file.path().string(),
        row[1].str(), row[2] == "greedy" ? "greedy" : "sample"))));
    const auto setting = nlohmann::json::parse(run.read("e.json")).at("settings").at(0);
    EXPECT_NEAR(100 * setting.at("success_rate").get<double>(), std::stod(row[3]), 6) << card;
  }
  EXPECT_GE(models, 3);
}

TEST_F(Eval, RepeatsItselfForAnyNumberOfThreads) {
  ASSERT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 50 --threads 1 --json 1.json")));
  ASSERT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 50 --threads 2 --json 2.json")));
  EXPECT_TRUE(succeeded(run("cmp 1.json 2.json")));
}

TEST_F(Eval, TakesOnePolicyOrTheOther) {
  const std::string table = run("eval --checkpoint ckpt --episodes 2 --greedy").out;
  EXPECT_TRUE(contains(table, "greedy"));
  EXPECT_EQ(table.find("sampled"), std::string::npos);
}

TEST_F(Eval, BreaksSuccessDownByVerbAndJoin) {
  ASSERT_TRUE(
      succeeded(run("eval --checkpoint ckpt --env Wordgaze-Two-N8-K4-v0 --episodes 40 "
                    "--sample --json e.json")));
  const auto setting = nlohmann::json::parse(run.read("e.json")).at("settings")[0];
  int episodes = 0;
  for (const char* join : {"and", "then", "after"}) {
    episodes += setting.at("by_join").at(join).at("episodes").get<int>();
  }
  EXPECT_EQ(episodes, 40);
  EXPECT_EQ(setting.at("by_clauses").at("2").at("episodes"), 40);
  EXPECT_TRUE(setting.at("by_verb").contains("pick up, go to"));
}

TEST_F(Eval, MeasuresTransparency) {
  const auto evaluated =
      run("eval --checkpoint ckpt --episodes 5 --sample --transparency --json e.json");
  ASSERT_TRUE(succeeded(evaluated));
  EXPECT_TRUE(contains(evaluated.out, "gaze M"));
  const auto t = nlohmann::json::parse(run.read("e.json")).at("settings")[0].at("transparency");
  EXPECT_GT(t.at("decisions"), 0);
  EXPECT_TRUE(t.at("gaze").at("pointing").at("target").is_number());
  EXPECT_TRUE(t.at("gradient").at("faithfulness").at("deletion").at("1").contains("brightest"));
  EXPECT_TRUE(t.at("words").at("content_weight").is_number());
  EXPECT_TRUE(t.at("mask").is_null());
}

TEST_F(Eval, DrawsPictures) {
  ASSERT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 2 --pictures p")));
  EXPECT_TRUE(succeeded(run("ls p/*.png && head -c 4 $(ls p/*.png | head -1) | grep -q PNG")));
}

TEST_F(Eval, RefusesMissingDamagedAndForeignCheckpoints) {
  EXPECT_TRUE(refused(run("eval --checkpoint nothing"), "nothing", "No such file or directory"));
  for (const std::string& damage : kDamages) {
    run("cp ckpt bad.safetensors; " + damage);
    EXPECT_TRUE(refused(run("eval --checkpoint bad.safetensors"), "bad.safetensors")) << damage;
  }
}

TEST_F(Eval, RefusesUnknownEnvironments) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --env BabyAI-GoToLokal-v0"),
                      "BabyAI-GoToLokal-v0", "BabyAI-GoToLocal-v0"));
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --env MiniGrid-MultiRoom-N6-v0 --objects 4"),
                      "MiniGrid-MultiRoom-N6-v0", "objects"));
}

TEST_F(Eval, RefusesARoomTooSmallForItsObjects) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --rooms 5 --objects 18"), "18"));
}

TEST_F(Eval, RefusesNumbersThatAreNone) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 0"), "--episodes"));
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --rooms eight"), "--rooms", "eight"));
}

TEST_F(Eval, RefusesPlacesThatCannotBeWritten) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 1 --json no/folder/e.json"),
                      "no/folder/e.json"));
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 1 --json /dev/full"), "/dev/full",
                      "No space left on device"));
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 1 --pictures ckpt"), "ckpt"));
}

TEST_F(Eval, RefusesToWriteOverWhatItReads) {
  run("ln -s ckpt link; cp ckpt before");
  for (const std::string output : {"ckpt", "link", "./ckpt"}) {
    EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 1 --json " + output), "--json",
                        "--checkpoint"));
#if WORDGAZE_WITH_LCM
    EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 1 --lcm-log " + output), "--lcm-log",
                        "--checkpoint"));
#endif
  }
  EXPECT_TRUE(refused(run("eval --checkpoint link --episodes 1 --json ckpt"), "--json"));
  EXPECT_TRUE(succeeded(run("cmp ckpt before")));
}

TEST_F(Eval, ChecksItsOutputsBeforeTheWork) {
  // Ten million episodes would outlast the test.
  for (const std::string output : {"--json no/dir/e.json", "--json .", "--pictures ckpt",
                                   "--json ckpt/e.json", "--json e.json --pictures /proc/p"}) {
    EXPECT_TRUE(
        refused(run("timeout 100 eval --checkpoint ckpt --episodes 10000000 " + output), "e"))
        << output;
  }
}

TEST_F(Eval, KeepsItsNumbersWhateverTheNameOfTheCheckpoint) {
  ASSERT_TRUE(
      succeeded(run("cp ckpt $'ck\\xff\\xfe'; eval --checkpoint $'ck\\xff\\xfe' "
                    "--episodes 2 --json e.json")));
  const auto report = nlohmann::json::parse(run.read("e.json"));
  EXPECT_EQ(report.at("settings").size(), 2u);
  EXPECT_TRUE(report.at("checkpoint").get<std::string>().starts_with("ck"));
}

TEST_F(Eval, SaysThatItsTableCouldNotBeWritten) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --episodes 2 --json e.json >/dev/full"),
                      "standard output", "No space left on device"));
  EXPECT_TRUE(contains(run.read("e.json"), "success_rate"));
  EXPECT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 2 2>&- >&-")));
}

TEST_F(Eval, SaysThatThereAreTooManyThreads) {
  const auto crowded = run("ulimit -v 400000; eval --checkpoint ckpt --episodes 5 --threads 256");
  EXPECT_TRUE(refused(crowded, "eval: "));
  EXPECT_EQ(crowded.err.find("terminate"), std::string::npos) << crowded.err;
}

TEST_F(Eval, StopsForASignal) {
  for (const std::string who : {"--checkpoint ckpt", "--policy bot --env BabyAI-GoToLocal-v0"}) {
    const auto stopped = run("timeout --foreground --preserve-status --signal=INT 1 eval " + who +
                             " --episodes 10000000 --json e.json");
    EXPECT_EQ(stopped.status, 130) << describe(stopped);
    EXPECT_TRUE(contains(stopped.err, "stopped by a signal"));
    EXPECT_FALSE(run.has("e.json"));
  }
}

TEST_F(Eval, EndsWellInLevelsOfEveryKind) {
  const std::string model = "'" WORDGAZE_SOURCE_DIR "/models/single-attention.safetensors'";
  for (const std::string id :
       {"MiniGrid-Playground-v0", "MiniGrid-Dynamic-Obstacles-5x5-v0", "MiniGrid-Empty-5x5-v0",
        "MiniGrid-MemoryS7-v0", "MiniGrid-GoToDoor-5x5-v0", "BabyAI-PutNextS5N2Carrying-v0",
        "BabyAI-BossLevel-v0", "Wordgaze-Eight-N8-K8-v0"}) {
    for (const std::string& checkpoint : {std::string("ckpt"), model}) {
      EXPECT_TRUE(
          succeeded(run("eval --checkpoint " + checkpoint + " --episodes 1 --greedy --env " + id)))
          << id;
    }
  }
}

#if WORDGAZE_WITH_LCM
TEST_F(Eval, LogsWhatHappenedAndWhatWasSeen) {
  ASSERT_TRUE(succeeded(
      run("eval --checkpoint ckpt --episodes 20 --sample --seed 500 --lcm-log e.lcmlog")));
  lcm::LogFile log((run.folder() / "e.lcmlog").string(), "r");
  ASSERT_TRUE(log.good());
  std::map<std::int64_t, env::Environment> worlds;
  int ended = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (event->channel == "WORDGAZE_EPISODE_BEGIN") {
      const auto begin = decoded<episode_begin_t>(*event);
      env::Environment world(begin.env_id);
      world.reset(static_cast<std::uint64_t>(begin.seed));
      EXPECT_EQ(begin.mission, world.mission());
      EXPECT_TRUE(worlds.emplace(begin.episode_id, std::move(world)).second);
    } else if (event->channel == "WORDGAZE_STEP") {
      const auto step = decoded<step_t>(*event);
      env::Environment& world = worlds.at(step.episode_id);
      EXPECT_EQ(step.step, world.step_count());
      std::array<std::uint8_t, grid::kImageBytes> image;
      world.observe(image);
      ASSERT_TRUE(std::ranges::equal(image, step.image)) << step.episode_id << ' ' << step.step;
      EXPECT_EQ(step.direction, world.direction());
      const auto transition = world.step(static_cast<grid::Action>(step.action));
      EXPECT_EQ(step.reward, static_cast<float>(transition.reward));
      EXPECT_EQ(step.terminated, transition.terminated);
      EXPECT_EQ(step.truncated, transition.truncated);
    } else if (event->channel == "WORDGAZE_EPISODE_END") {
      const auto end = decoded<episode_end_t>(*event);
      EXPECT_EQ(end.num_steps, worlds.at(end.episode_id).step_count());
      ++ended;
    }
  }
  EXPECT_EQ(ended, 20);
}

// The live view may have no way out here; the log hears the same.
TEST_F(Eval, LiveIsOneEpisodeAtATimeAtItsPace) {
  const std::string eval =
      "eval --checkpoint '" WORDGAZE_SOURCE_DIR
      "/models/single-attention.safetensors' --episodes 4 --greedy --seed 500 ";
  const auto live = run(eval +
                        "--lcm-url 'udpm://239.255.76.69:29999?ttl=0' --live --hz 100 "
                        "--lcm-log live.lcmlog");
  ASSERT_TRUE(succeeded(live));
  EXPECT_EQ(live.out, run(eval).out);
  lcm::LogFile log((run.folder() / "live.lcmlog").string(), "r");
  ASSERT_TRUE(log.good());
  std::int64_t running = -1, before = 0, first = 0;
  int steps = 0, ended = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    if (event->channel == "WORDGAZE_EPISODE_BEGIN") {
      EXPECT_EQ(running, -1);
      running = decoded<episode_begin_t>(*event).episode_id;
    } else if (event->channel == "WORDGAZE_STEP") {
      const auto step = decoded<step_t>(*event);
      EXPECT_EQ(step.episode_id, running);
      if (first == 0) first = step.utime;
      before = step.utime;
      ++steps;
    } else if (event->channel == "WORDGAZE_EPISODE_END") {
      running = -1;
      ++ended;
    }
  }
  EXPECT_EQ(ended, 4);
  ASSERT_GT(steps, 10);
  EXPECT_GE(static_cast<double>(before - first), 1e4 * (steps - 1) - 5e3);  // microseconds
}

TEST_F(Eval, LiveStopsForASignalBetweenTwoSteps) {
  const auto stopped =
      run("timeout --foreground --preserve-status --signal=INT 1 eval --checkpoint ckpt --live "
          "--hz 0.01 --lcm-url 'udpm://239.255.76.69:29999?ttl=0'");
  EXPECT_EQ(stopped.status, 130) << describe(stopped);
}

TEST_F(Eval, LiveIsForWhoeverWatches) {
  const std::string eval = "eval --checkpoint ckpt --episodes 1 ";
  EXPECT_TRUE(refused(run(eval + "--live"), "--live", "--lcm-url"));
  EXPECT_TRUE(refused(run(eval + "--hz 5"), "--hz", "--live"));
  for (const std::string hz : {"0", "-1", "1e9", "nan", "inf", "x"}) {
    EXPECT_TRUE(refused(run(eval + "--live --lcm-url udpm:// --hz " + hz), "--hz")) << hz;
  }
}
#else
TEST_F(Eval, SaysThatItWasBuiltWithoutLcm) {
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --lcm-log e.lcmlog"), "without LCM"));
}
#endif

}  // namespace
}  // namespace wordgaze
