#include "wordgaze/model/agent.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/agent_fixture.hpp"
#include "wordgaze/model/reference.hpp"
#include "wordgaze/nn/gradient_check.hpp"

template struct wordgaze::model::Agent<double>;

namespace wordgaze::model {
namespace {

using test::AgentFixture;
using test::random_matrix;

Config variant(bool attention, bool task_attention, double exponent = 2) {
  Config c = test::small_config();
  c.attention = attention;
  c.task_attention = task_attention;
  c.gaze_exponent = exponent;
  return c;
}

Config with_reader(Reader reader, Gaze gaze) {
  Config c = variant(true, true);
  c.task_reader = reader;
  c.gaze = gaze;
  return c;
}

/// The paper's gaze.
Config with_sum(bool task_attention, double exponent = 2) {
  Config c = variant(true, task_attention, exponent);
  c.gaze = Gaze::sum;
  c.task_reader = Reader::sum;
  return c;
}

Config with_completion_input() {
  Config c = variant(true, false);
  c.completion_input = true;
  return c;
}

Config with_patches(Config c) {
  c.encoder = Encoder::patch;
  c.gaze = Gaze::sum;
  c.task_reader = Reader::sum;
  return c;
}

/// Set by training, not learned.
bool is_fixed(const nn::Path& path) { return path.str() == "attention.focus"; }

struct AgentVariant : testing::TestWithParam<Config> {
  AgentFixture<double> f{GetParam()};
  void expect_plain_twin();
  void expect_gradients_of_central_differences();
};

void AgentVariant::expect_plain_twin() {
  f.forward();
  const auto twin = ReferenceAgent<double>{f.agent, f.params}.run(f.frames, f.missions);
  EXPECT_TRUE(f.outputs.logits.isApprox(twin.logits, 1e-12));
  EXPECT_TRUE(f.outputs.values.isApprox(twin.values, 1e-12));
  for (Index n = 0; n < f.outputs.mask.cols() && f.outputs.mask.rows() > 0; ++n) {
    const Index words = f.missions[f.frames.mission(n)].length;
    EXPECT_TRUE(f.outputs.mask.col(n).head(words).isApprox(twin.mask.col(n).head(words), 1e-12));
  }
}

void AgentVariant::expect_gradients_of_central_differences() {
  const Outputs<double> asked = f.random_gradient();
  const auto loss = [&] {
    f.forward();
    // Of the mask, a loss on the logits of alpha, as L_TA is.
    const auto alpha = f.outputs.mask.array();
    const auto asked_of_mask = asked.mask.array();
    return f.outputs.logits.cwiseProduct(asked.logits).sum() +
           f.outputs.values.cwiseProduct(asked.values).sum() +
           (asked_of_mask != 0).select((alpha / (1 - alpha)).log() * asked_of_mask, 0).sum();
  };
  f.agent.refresh(f.weights);
  const auto grads = f.gradient(asked);
  const nn::GradientError error = nn::check_gradients(f.params, grads, loss, is_fixed);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST_P(AgentVariant, EqualsItsPlainTwin) { expect_plain_twin(); }

TEST_P(AgentVariant, GradientsMatchCentralDifferences) {
  expect_gradients_of_central_differences();
}

TEST_P(AgentVariant, AMissionWithoutWordsGoesBesideOthers) {
  f.missions.replace(f.frames.mission(0), {});
  expect_plain_twin();
  expect_gradients_of_central_differences();
}

TEST_P(AgentVariant, NoMissionNeedHaveWords) {
  f.missions.clear();
  f.missions.index_of({});
  std::ranges::fill(f.frames.mission_of, 0);
  expect_plain_twin();
  const auto grads = f.gradient(f.random_gradient());
  nn::for_each_parameter(
      [](const nn::Path& path, const auto& g) { EXPECT_TRUE(g.allFinite()) << path.str(); }, grads);
}

TEST_P(AgentVariant, WorkersSumUpToTheSameGradient) {
  f.agent.refresh(f.weights);
  const Outputs<double> asked = f.random_gradient();
  const auto alone = f.gradient(asked), three = f.gradient(asked, 3);
  nn::for_each_parameter(
      [](const nn::Path& path, const auto& a, const auto& b) {
        EXPECT_TRUE(a.isApprox(b, 1e-10)) << path.str();
        EXPECT_TRUE(a.size() == 0 || is_fixed(path) || a.cwiseAbs().maxCoeff() > 0) << path.str();
      },
      alone, three);
}

TEST_P(AgentVariant, PaddingBehindAMissionChangesNothing) {
  f.forward();
  const Outputs<double> before = f.outputs;
  // A longer mission in the batch makes every other one padded; foreign words behind the end too.
  f.missions.index_of({test::sentence("pick up the red key and go to the red box after you"), {}});
  for (auto& s : f.missions.sentences) {
    for (auto i = static_cast<std::size_t>(s.length); i < s.words.size(); ++i) s.words[i] = 17;
  }
  f.forward();
  // Sums over columns of another height may round differently: the last bit is free.
  EXPECT_TRUE(before.logits.isApprox(f.outputs.logits, 1e-14));
  EXPECT_TRUE(before.values.isApprox(f.outputs.values, 1e-14));
}

TEST_P(AgentVariant, AllocatesNothingAfterTheFirstPass) {
  AgentFixture<double> g(GetParam(), {4, 8});
  const Outputs<double> asked = g.random_gradient();
  auto grads = g.agent.make_gradients(1);
  Team team(1);
  const auto pass = [&] {
    g.agent.refresh(g.weights, team);
    g.agent.encode_text(g.weights, g.missions, g.cache, g.text);
    g.agent.forward(g.weights, g.frames, g.missions, g.text, g.cache, g.outputs);
    g.agent.backward(g.weights, g.frames, g.missions, g.outputs, asked, g.cache, grads.front());
    g.agent.reduce(g.weights, grads, team);
  };
  g.forward();
  pass();
  Eigen::internal::set_is_malloc_allowed(false);
  pass();
  Eigen::internal::set_is_malloc_allowed(true);
}

INSTANTIATE_TEST_SUITE_P(
    Readings, AgentVariant,
    testing::Values(variant(false, false), variant(true, false), with_sum(false),
                    with_sum(false, 1), with_sum(false, 3), with_sum(true), with_sum(true, 1),
                    with_reader(Reader::sum, Gaze::product), with_reader(Reader::places, Gaze::sum),
                    with_reader(Reader::scan, Gaze::sum), with_reader(Reader::scan, Gaze::product),
                    with_completion_input(), with_patches(variant(false, false)),
                    with_patches(variant(true, false)), with_patches(variant(true, true, 1))),
    [](const auto& variant_info) {
      const Config& c = variant_info.param;
      std::string name = c.encoder == Encoder::patch ? "Patch" : "";
      if (!c.attention) return name + "Baseline";
      if (c.completion_input) name += "CompletionInput";
      if (c.task_attention) name += "Task_" + std::string(name_of(c.task_reader));
      name += c.gaze == Gaze::sum ? "Sum" : "Product";
      return name + "P" + std::to_string(static_cast<int>(c.gaze_exponent));
    });

TEST(Agent, AttentionIsADistribution) {
  AgentFixture<double> f(variant(true, true));
  f.forward();
  const auto& a = f.cache.attention;
  for (Index n = 0; n < f.frames.shape.columns(); ++n) {
    const int length = f.missions[f.frames.mission_of[static_cast<std::size_t>(n)]].length;
    for (int i = 0; i < length; ++i) {
      double sum = a.maps(a.nowhere, a.map(n, i));
      for (Index c = 0; c < 49; ++c)
        sum += a.maps(f.agent.entry(f.frames.cells, c, n), a.map(n, i));
      EXPECT_NEAR(sum, 1, 1e-12);
    }
    EXPECT_NEAR(a.weights.col(n).sum(), 1, 1e-12);
    EXPECT_EQ(a.weights.col(n).tail(a.weights.rows() - length).cwiseAbs().sum(), 0);
    EXPECT_GT(f.outputs.mask.col(n).head(length).minCoeff(), 0);
    EXPECT_LT(f.outputs.mask.col(n).head(length).maxCoeff(), 1);
  }
}

TEST(Agent, SurvivesScoresFarBelowThoseOutOfView) {
  // The largest score of the table belongs to a code that no frame shows.
  AgentFixture<double> f(with_sum(false));
  f.forward();
  const int hidden_code = f.agent.alphabet.find({5, 0, 0});
  for (Index i = 0; i < f.frames.cells.size(); ++i) {
    if (f.frames.cells.data()[i] == hidden_code) f.frames.cells.data()[i] = 1;
  }
  f.weights.tables.vision.cells.scores.row(hidden_code).setConstant(1000);
  f.forward_frames();
  EXPECT_TRUE(f.outputs.logits.allFinite());
  EXPECT_GT(f.cache.attention.scale.colwise().maxCoeff().minCoeff(), 0.99);
}

TEST(Agent, RefusesAMissionThatTheTaskModuleCannotHold) {
  Config c = with_sum(true);
  c.task_words = 4;
  AgentFixture<double> f(c);
  EXPECT_THROW(f.forward(), std::invalid_argument);
}

TEST(Config, RefusesTaskAttentionWithoutAttention) {
  EXPECT_THROW(validate(variant(false, true)), std::invalid_argument);
}

TEST(CellAlphabet, EncodesAViewAndRefusesForeignCells) {
  const auto alphabet = CellAlphabet::one_room();
  EXPECT_EQ(alphabet.size(), 21);
  std::array<std::uint8_t, grid::kImageBytes> image{};
  std::array<std::uint8_t, grid::kViewCells> cells{};
  image[3] = 6;  // a blue ball in cell 1
  image[4] = 2;
  alphabet.encode(image, cells);
  EXPECT_EQ(cells[0], 0);
  EXPECT_EQ(alphabet[cells[1]], (CellAlphabet::Code{6, 2, 0}));
  image[6] = 4;  // a door in cell 2
  EXPECT_THROW(alphabet.encode(image, cells), std::invalid_argument);
  image[6] = 200;
  EXPECT_THROW(alphabet.encode(image, cells), std::invalid_argument);
  EXPECT_LE(CellAlphabet::everything().size(), kMaxCodes);
}

}  // namespace
}  // namespace wordgaze::model
