#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "wordgaze/babyai/layout.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/trace/record.hpp"
#include "wordgaze/trace/replay.hpp"

namespace wordgaze::trace {
namespace {

constexpr const char* kFiles[] = {"babyai", "minigrid",   "wordgaze",   "exact",
                                  "full",   "exact_enum", "large_seeds"};

// The traces of scripts/golden/make, apart by file and id.
struct Golden {
  std::string file, id, text;
};

std::vector<Golden> goldens() {
  std::vector<Golden> all;
  for (const std::string file : kFiles) {
    std::ifstream in(WORDGAZE_TEST_DATA "/traces/" + file + ".jsonl");
    std::string meta, line;
    std::getline(in, meta);
    while (std::getline(in, line)) {
      const auto record = nlohmann::json::parse(line);
      const std::string id = record.value("env", all.empty() ? "" : all.back().id);
      if (all.empty() || all.back().id != id || all.back().file != file) {
        all.push_back({file, id, meta + '\n'});
      }
      all.back().text += line + '\n';
    }
  }
  return all;
}

std::ostream& operator<<(std::ostream& out, const Golden& golden) {
  return out << golden.file << ' ' << golden.id;
}

class GoldenTrace : public testing::TestWithParam<Golden> {};

TEST_P(GoldenTrace, IsReplayedExactly) {
  std::istringstream trace(GetParam().text);
  std::ostringstream details;
  const ReplayReport report = replay(trace, details);
  EXPECT_EQ(report.mismatches, 0) << details.str();
  EXPECT_GT(report.resets, 0);
}

INSTANTIATE_TEST_SUITE_P(, GoldenTrace, testing::ValuesIn(goldens()), [](const auto& test) {
  std::string name = test.param.file + '_' + test.param.id;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

TEST(GoldenTraces, CoverEveryLevel) {
  std::set<std::string> ids;
  for (const Golden& golden : goldens()) ids.insert(golden.id);
  for (const auto& level : babyai::built_in_levels()) EXPECT_TRUE(ids.contains(level.id));
  for (const char* id : {"Wordgaze-One-N5-K2-v0", "Wordgaze-Two-N5-K2-v0",
                         "Wordgaze-Three-N5-K4-v0", "Wordgaze-Four-N5-K4-v0"}) {
    EXPECT_TRUE(ids.contains(id)) << id;
  }
}

std::string recorded(RecordOptions options) {
  std::ostringstream out;
  record(options, out);
  return out.str();
}

TEST(Trace, ReplaysWhatItRecords) {
  const std::string text =
      recorded({.ids = {"BabyAI-MiniBossLevel-v0", "Wordgaze-Two-N8-K4-v0",
                        "Wordgaze-Eight-N8-K8-v0", "MiniGrid-Dynamic-Obstacles-6x6-v0"},
                .first_seed = 3,
                .end_seed = 5,
                .steps = 50});
  std::istringstream trace(text);
  std::ostringstream details;
  const ReplayReport report = replay(trace, details);
  EXPECT_EQ(report.mismatches, 0) << details.str();
  EXPECT_EQ(report.envs, 4);
  EXPECT_EQ(report.steps, 4 * 2 * 50);
}

// Turns left for ever.
struct Turning {
  grid::Action operator()(const env::Environment&) const { return grid::Action::left; }
};

TEST(Trace, RecordsWhoeverActs) {
  std::istringstream lines(recorded(
      {.ids = {"BabyAI-GoToLocal-v0"},
       .end_seed = 2,
       .steps = 5,
       .policy = [](std::string_view, std::uint64_t, std::uint64_t) { return Turning{}; }}));
  int steps = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto record = nlohmann::json::parse(line);
    if (record["t"] != "step") continue;
    EXPECT_EQ(record["a"], static_cast<int>(grid::Action::left));
    ++steps;
  }
  EXPECT_EQ(steps, 2 * 5);
}

// A level of a user's own: a ball to go to.
TEST(Trace, ReplaysALevelOfOnesOwn) {
  babyai::register_level({.id = "Own-GoToBall-v0",
                          .generate =
                              [](babyai::Layout& layout) {
                                layout.place_agent();
                                const auto ball = layout.add_object({}, grid::Type::ball);
                                layout.scatter_objects();
                                layout.require_reachable();
                                layout.ask(babyai::Verb::go_to, layout.describe(ball));
                              },
                          .room_size = 6,
                          .rows = 1,
                          .columns = 1,
                          .parameters = babyai::Objects{.count = 3}});
  std::istringstream trace(
      recorded({.ids = {"Own-GoToBall-v0", "Own-GoToBall-v0[room_size=9]"}, .steps = 50}));
  std::ostringstream details;
  const ReplayReport report = replay(trace, details);
  EXPECT_EQ(report.mismatches, 0) << details.str();
  EXPECT_EQ(report.envs, 2);
  EXPECT_EQ(report.steps, 2 * 4 * 50);
}

// A trace with one field of one record changed is found, whatever the field.
TEST(Trace, FindsEveryChangedField) {
  std::istringstream lines(recorded({.ids = {"Wordgaze-Two-N8-K4-v0"}, .end_seed = 1, .steps = 3}));
  std::vector<nlohmann::ordered_json> records;
  for (std::string line; std::getline(lines, line);) {
    records.push_back(nlohmann::ordered_json::parse(line));
  }
  const std::set<std::string> not_compared{"t", "env", "seed", "chain", "ep", "a", "done_actions"};
  int changed = 0;
  for (std::size_t k = 1; k <= 2; ++k) {  // the reset and the first step
    for (const auto& [key, value] : records[k].items()) {
      if (not_compared.contains(key)) continue;
      auto altered = records;
      altered[k][key] = "something else";
      if (key == "rng") {
        altered[k][key] = value;
        altered[k][key]["state"] = std::string(32, '0');
      }
      std::stringstream trace;
      for (const auto& record : altered) trace << record << '\n';
      std::ostringstream details;
      EXPECT_EQ(replay(trace, details).mismatches, 1) << key;
      EXPECT_NE(details.str().find(key), std::string::npos);
      ++changed;
    }
  }
  EXPECT_GE(changed, 20);
}

TEST(Trace, NamesTheLineThatIsNoRecord) {
  for (const char* text :
       {"{\"t\":\"meta\"}\n{\"t\":\"reset\"", "{\"t\":\"meta\"}\n{\"t\":\"what\"}",
        "{\"t\":\"meta\"}\n{\"t\":\"step\",\"a\":1}", "{\"t\":\"meta\"}\n17"}) {
    std::istringstream trace(text);
    std::ostringstream details;
    try {
      replay(trace, details);
      FAIL() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
    }
  }
}

TEST(Trace, RefusesSeedsAndActionsThatAreNone) {
  const std::string reset = R"({"t":"reset","env":"BabyAI-GoToLocal-v0","seed":)";
  for (const std::string& text :
       {reset + "-1}", reset + "1.5}", reset + "1}\n{\"t\":\"step\",\"a\":7}",
        reset + "1}\n{\"t\":\"step\",\"a\":-1}"}) {
    std::istringstream trace(text);
    std::ostringstream details;
    EXPECT_THROW(replay(trace, details), std::runtime_error) << text;
  }
}

TEST(Trace, RefusesAnUnknownId) {
  std::istringstream trace("{\"t\":\"reset\",\"env\":\"BabyAI-Nothing-v0\",\"seed\":1}");
  std::ostringstream details;
  EXPECT_THROW(replay(trace, details), std::invalid_argument);
}

TEST(Replay, OfNothingIsAnError) {
  std::ostringstream details;
  for (const std::string text : {"", "{\"t\":\"meta\"}\n"}) {
    std::istringstream in(text);
    EXPECT_THROW(replay(in, details), std::runtime_error) << text;
  }
  std::ifstream folder("/");
  EXPECT_THROW(replay(folder, details), std::runtime_error);
}

}  // namespace
}  // namespace wordgaze::trace
