#include "wordgaze/page/episode_page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "evaluation/one_decision.hpp"
#include "page/shares.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/evaluation/evaluator.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::page {
namespace {

/// What stands in the page for the script to show.
nlohmann::json data_of(const std::string& html) {
  const std::string_view opening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = html.find(opening) + opening.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

std::vector<int> bytes_of(const std::string& base64) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<int> bytes;
  int bits = 0, count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<int>(letters.find(c));
    count += 6;
    if (count >= 8) bytes.push_back(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// The same numbers as bytes.
std::vector<int> in_steps(const Eigen::Ref<const Vector<float>>& numbers) {
  std::vector<int> steps;
  for (Index i = 0; i < numbers.size(); ++i) {
    steps.push_back(static_cast<int>(std::lround(255 * numbers(i))));
  }
  return steps;
}

/// Looks at the same decisions, with numbers of its own.
class Witness final : public evaluation::DecisionObserver {
 public:
  std::vector<std::vector<int>> policies, gazes, without_first_word;

  void on_decision(const evaluation::DecisionContext& context) override {
    const model::CellMatrix view = context.policy.frames().cells.col(context.lane);
    policies.push_back(in_steps(context.policy.policies_for(context.lane, view).col(0)));
    policy::AttentionRecord record;
    context.policy.attention(context.lane, record);
    gazes.push_back(in_steps(Eigen::Map<const Vector<float>>(
        record.gaze.data(), static_cast<Index>(record.gaze.size()))));
    // A policy of its own that is told the shorter mission.
    const babyai::Sentence& sentence = context.policy.sentence(context.lane);
    babyai::Sentence rest;
    for (int i = 1; i < sentence.length; ++i) {
      rest.append(sentence.words[static_cast<std::size_t>(i)],
                  sentence.sub_task_of[static_cast<std::size_t>(i)]);
    }
    const std::array<babyai::Sentence, 1> missions{rest};
    without_first_word.push_back(
        in_steps(context.policy.policies_for(context.lane, missions).col(0)));
  }
};

struct Evaluated {
  Witness witness;
  EpisodePage page{"agent </script> & co", 2};

  Evaluated() {
    test::OneDecision at(true);
    at.agent.refresh(at.weights);
    Team team(1);
    evaluation::DecisionObservers decisions;
    decisions.add(&page);
    decisions.add(&witness);
    page.on_run("sampled");
    evaluation::evaluate(
        evaluation::policy_factory(at.agent, at.weights),
        {.level = babyai::find_level("Wordgaze-Two-N8-K4-v0"), .episodes = 2, .lanes = 1}, team,
        {.episodes = &page, .decisions = decisions.or_null()});
  }
};

TEST(EpisodePage, HoldsWhatTheAgentSawAndDid) {
  const Evaluated evaluated;
  const auto data = data_of(evaluated.page.html());
  ASSERT_EQ(data["episodes"].size(), 2u);
  std::size_t number = 0;
  for (const auto& episode : data["episodes"]) {
    EXPECT_EQ(episode["run"], "sampled");
    EXPECT_EQ(episode["env"], "Wordgaze-Two-N8-K4-v0");
    const std::size_t words = episode["words"].size();
    EXPECT_EQ(episode["sub_task_of"].size(), words);
    EXPECT_TRUE(episode.contains("success"));
    env::Environment again("Wordgaze-Two-N8-K4-v0");
    again.reset(std::stoull(episode["seed"].get<std::string>()));
    EXPECT_EQ(episode["mission"], again.mission());
    std::vector<int> cells;
    for (const auto& step : episode["steps"]) {
      const auto seen = policy::observe(again);
      EXPECT_EQ(bytes_of(step["image"]), std::vector<int>(seen.image.begin(), seen.image.end()));
      if (step.contains("cells")) cells = bytes_of(step["cells"]);
      std::vector<std::uint8_t> world;
      grid::write_cells(again.world(), world);
      EXPECT_EQ(cells, std::vector<int>(world.begin(), world.end()));
      EXPECT_EQ(step["at"][0], again.world().agent.x);
      EXPECT_EQ(step["targets"].size(),
                babyai::target_cells(again.world(), again.progress()).size());
      EXPECT_EQ(bytes_of(step["policy"]), evaluated.witness.policies.at(number));
      EXPECT_EQ(bytes_of(step["gaze"]), evaluated.witness.gazes.at(number));
      EXPECT_EQ(bytes_of(step["maps"]).size(), 49 * words);
      EXPECT_EQ(bytes_of(step["filter"]).size(), 49u);
      again.step(static_cast<grid::Action>(step["action"]));
      ++number;
    }
  }
  EXPECT_EQ(number, evaluated.witness.policies.size());
}

TEST(EpisodePage, SaysWhatWouldBeWithoutAWordOrACell) {
  const Evaluated evaluated;
  const auto data = data_of(evaluated.page.html());
  std::size_t number = 0, moved = 0;
  for (const auto& episode : data["episodes"]) {
    for (const auto& step : episode["steps"]) {
      const auto& what_if = step["what_if"];
      EXPECT_EQ(what_if["words"].size(), episode["words"].size());
      EXPECT_EQ(bytes_of(what_if["words"][0]), evaluated.witness.without_first_word.at(number));
      moved += bytes_of(what_if["words"][0]) != bytes_of(step["policy"]);
      const auto image = bytes_of(step["image"]);
      std::size_t things = 0;
      for (std::size_t c = 0; c < 49; ++c) things += image[3 * c] > 2;
      EXPECT_EQ(what_if.contains("cells") ? what_if["cells"].size() : 0u, things);
      ++number;
    }
  }
  EXPECT_GT(moved, number / 2);
}

TEST(EpisodePage, TakesTheFirstEpisodesOfEachRun) {
  EpisodePage page("two", 2);
  const babyai::Sentence sentence = babyai::sentence_of("go to the red ball");
  const auto tell = [&](std::int64_t id) {
    if (!page.wants_episode(id)) return;
    page.on_begin({.episode = id, .env_id = "e", .sentence = sentence, .mission = "m"});
    page.on_end({.episode = id, .success = true});
  };
  page.on_run("sampled");
  for (const int id : {0, 1, 2}) tell(id);
  page.on_run("greedy");
  for (const int id : {3, 4, 5}) tell(id);
  const auto data = data_of(page.html());
  std::vector<int> ids;
  for (const auto& episode : data["episodes"]) ids.push_back(episode["id"]);
  EXPECT_EQ(ids, (std::vector<int>{0, 1, 3, 4}));
}

TEST(EpisodePage, IsOneWellFormedFileWhateverTheNames) {
  const Evaluated evaluated;
  const TemporaryFolder folder;
  evaluated.page.write(folder / "page.html");
  const std::string html = io::read_file(folder / "page.html");
  EXPECT_EQ(html, evaluated.page.html());
  EXPECT_NE(html.find("<title>agent &lt;/script> &amp; co</title>"), html.npos);
  EXPECT_EQ(data_of(html)["title"], "agent </script> & co");
  for (const std::string_view mark :
       {"{{title", "{{episodes", "@page", "src=", "http:", "https:"}) {
    EXPECT_EQ(html.find(mark), html.npos) << mark;
  }
}

TEST(Shares, AreBytesAsText) {
  const std::array<float, 4> numbers{0, 0.5f, 1, 7};
  EXPECT_EQ(bytes_of(shares(numbers)), (std::vector<int>{0, 128, 255, 255}));
  const std::array<float, 2> odd{std::nanf(""), -1};
  EXPECT_EQ(bytes_of(shares(odd)), (std::vector<int>{0, 0}));
  const std::array<std::uint8_t, 5> five{1, 2, 3, 4, 255};
  EXPECT_EQ(base64(five), "AQIDBP8=");
}

}  // namespace
}  // namespace wordgaze::page
