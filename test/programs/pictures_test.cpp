#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "programs/tiny_run.hpp"
#include "support/messages.hpp"

namespace wordgaze {
namespace {

/// One trained agent: ckpt in the folder.
struct Pictures : ::testing::Test {
  Shell run;
  Pictures() {
    write_tiny_config(run);
    run("train --config tiny.toml --out a && mv a/checkpoint.safetensors ckpt");
  }
  std::set<std::string> files(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(run.folder() / folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

/// The last step that is drawn, by the part of the names before it.
std::map<std::string, int> last_steps(const std::set<std::string>& names) {
  std::map<std::string, int> last;
  for (const std::string& name : names) {
    const auto at = name.find("-step");
    EXPECT_NE(at, std::string::npos) << name;
    int& step = last[name.substr(0, at)];
    step = std::max(step, std::stoi(name.substr(at + 5)));
  }
  return last;
}

// The last decision of each episode is drawn: their steps are those of the evaluation.
TEST_F(Pictures, AreOfTheEpisodesAndPolicyThatWereEvaluated) {
  for (const std::string policy : {"greedy", "sample"}) {
    ASSERT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 4 --seed 77 --" + policy +
                              " --json e.json --pictures " + policy)));
    const auto setting = nlohmann::json::parse(run.read("e.json")).at("settings").at(0);
    const auto last = last_steps(files(policy));
    ASSERT_EQ(last.size(), 4u);
    double steps = 0;
    for (const auto& [episode, step] : last) {
      EXPECT_EQ(episode.rfind(setting.at("policy").get<std::string>() + "-episode0", 0), 0u)
          << episode;
      steps += step + 1;
    }
    EXPECT_DOUBLE_EQ(steps / 4, setting.at("mean_steps").get<double>());
  }
}

TEST_F(Pictures, ChangeNoResult) {
  const std::string eval = "eval --checkpoint ckpt --episodes 9 --rooms 6,8 --threads 1 ";
  ASSERT_TRUE(succeeded(run(eval + "--json without.json")));
  ASSERT_TRUE(succeeded(run(eval + "--json with.json --pictures p")));
  EXPECT_TRUE(succeeded(run("cmp with.json without.json")));
  // Six episodes a policy, of the first setting.
  EXPECT_EQ(last_steps(files("p")).size(), 12u);
}

TEST_F(Pictures, OfAnEarlierEvaluationGoAndNothingElse) {
  run("mkdir p; for name in greedy-episode07-step000.png episode03-step120.png sampled.png "
      "my-episode07-step000.png greedy-episode07-step000.png.txt; do echo >p/$name; done; "
      "mkdir p/greedy-episode08-step000.png");
  ASSERT_TRUE(succeeded(run("eval --checkpoint ckpt --episodes 2 --sample --pictures p")));
  const auto names = files("p");
  EXPECT_FALSE(names.contains("greedy-episode07-step000.png"));
  EXPECT_FALSE(names.contains("episode03-step120.png"));
  for (const char* kept : {"sampled.png", "my-episode07-step000.png",
                           "greedy-episode07-step000.png.txt", "greedy-episode08-step000.png"}) {
    EXPECT_TRUE(names.contains(kept)) << kept;
  }
  EXPECT_TRUE(names.contains("sampled-episode00-step000.png"));
}

TEST_F(Pictures, StayWhereTheEvaluationIsRefused) {
  run("mkdir p; echo >p/greedy-episode07-step000.png");
  EXPECT_TRUE(refused(run("eval --checkpoint ckpt --env Nowhere --pictures p"), "Nowhere"));
  EXPECT_TRUE(run.has("p/greedy-episode07-step000.png"));
}

#if WORDGAZE_WITH_LCM
TEST_F(Pictures, MayLieBesideTheLog) {
  ASSERT_TRUE(succeeded(
      run("eval --checkpoint ckpt --episodes 2 --greedy --pictures p --lcm-log p/e.lcmlog")));
  EXPECT_TRUE(files("p").contains("e.lcmlog"));
  EXPECT_GT(files("p").size(), 2u);
}
#endif

}  // namespace
}  // namespace wordgaze
