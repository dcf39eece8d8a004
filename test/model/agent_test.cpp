#include "wordgaze/model/agent_impl.hpp"

#include <gtest/gtest.h>

#include "model/agent_fixture.hpp"
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

Config with_task_places() {
  Config c = variant(true, true);
  c.task_places = true;
  return c;
}

Config with_completion_input() {
  Config c = variant(true, false);
  c.completion_input = true;
  return c;
}

Config with_patches(Config c) {
  c.encoder = Encoder::patch;
  return c;
}

/// The agent written a second time from the equations: one-hot cells, all 49 of them, one frame and
/// one word at a time, no tables.
struct PlainTwin {
  const AgentFixture<double>& f;

  Vector<double> logistic(const Vector<double>& v) const { return 1 / (1 + (-v.array()).exp()); }

  Vector<double> text(const babyai::Sentence& s) const {
    const auto& p = f.params.text;
    const Index g = p.hidden_weight.cols();
    Vector<double> h = Vector<double>::Zero(g);
    for (const auto word : s) {
      const Vector<double> x = p.input_weight * f.params.words.col(word) + p.bias;
      const Vector<double> u = p.hidden_weight * h;
      const Vector<double> r = logistic(x.head(g) + u.head(g));
      const Vector<double> z = logistic(x.segment(g, g) + u.segment(g, g));
      const Vector<double> n =
          (x.tail(g).array() + r.array() * (u.tail(g) + p.candidate_bias).array()).tanh();
      h = (1 - z.array()) * n.array() + z.array() * h.array();
    }
    return h;
  }

  /// A convolution with square kernels of 1x1 or 3x3, zeros around the view, then the leaky ReLU.
  Matrix<double> convolve(const Matrix<double>& weight, const Vector<double>& bias,
                          const Matrix<double>& view) const {
    const Index in = view.rows(), reach = weight.cols() == in ? 0 : 1;
    Matrix<double> out(weight.rows(), 49);
    for (Index a = 0; a < 7; ++a) {
      for (Index b = 0; b < 7; ++b) {
        Vector<double> sum = bias;
        Index tap = 0;
        for (Index da = -reach; da <= reach; ++da) {
          for (Index db = -reach; db <= reach; ++db, ++tap) {
            if (a + da < 0 || a + da > 6 || b + db < 0 || b + db > 6) continue;
            sum += weight.middleCols(tap * in, in) * view.col((a + da) * 7 + b + db);
          }
        }
        out.col(a * 7 + b) = sum.cwiseMax(f.agent.config.encoder_leak * sum);
      }
    }
    return out;
  }

  /// O~ of a frame.
  Matrix<double> encode(Index n) const {
    Matrix<double> view = Matrix<double>::Zero(20, 49);
    for (Index cell = 0; cell < 49; ++cell) {
      const auto code = f.agent.alphabet[f.frames.cells(cell, n)];
      view(code.type, cell) = view(11 + code.color, cell) = view(17 + code.state, cell) = 1;
    }
    const auto& p = f.params;
    if (f.agent.config.encoder == Encoder::cell) {
      return convolve(p.visual.weight, p.visual.bias, view);
    }
    return convolve(p.patches.second.weight, p.patches.second.bias,
                    convolve(p.patches.first.weight, p.patches.first.bias, view));
  }

  /// Attention over the view: the map M, or nothing without attention.
  Vector<double> scale(Index n, const Matrix<double>& encoding, const babyai::Sentence& s) const {
    const Config& c = f.agent.config;
    if (!c.attention) return Vector<double>::Ones(49);
    Matrix<double> maps(s.length, 49);
    Vector<double> entropy(s.length);
    for (int i = 0; i < s.length; ++i) {
      const Vector<double> q = f.params.attention.query * f.params.words.col(s.words[i]);
      for (Index cell = 0; cell < 49; ++cell) {
        const Vector<double> k = f.params.attention.key * encoding.col(cell);
        maps(i, cell) = std::exp(q.dot(k) / std::sqrt(static_cast<double>(c.key_size)));
      }
      maps.row(i) /= maps.row(i).sum();
      entropy(i) =
          -(maps.row(i).array() * maps.row(i).array().log()).sum() / std::log(c.entropy_base);
    }
    Vector<double> w = (-entropy.array()).exp();
    w /= w.sum();
    if (c.task_attention) {
      Vector<double> x = Vector<double>::Zero(f.params.task.hidden.weight.cols());
      for (int i = 0; i < s.length; ++i) {
        const Index row = c.task_places ? i * c.word_size : 0;
        x.segment(row, c.word_size) += w(i) * f.params.words.col(s.words[i]);
      }
      x.tail(c.clauses) = f.frames.completion.col(n);
      const auto& t = f.params.task;
      const Vector<double> hidden = (t.hidden.weight * x + t.hidden.bias).cwiseMax(0);
      const Vector<double> alpha = logistic(t.output.weight * hidden + t.output.bias);
      w.array() *= alpha.head(s.length).array();
    }
    const Vector<double> gaze = maps.transpose() * w;
    return c.gaze_floor +
           (1 - c.gaze_floor) * (gaze.array() / (gaze.maxCoeff() + 1e-6)).pow(c.gaze_exponent);
  }

  /// Logits over value, [8, N].
  Matrix<double> run() const {
    const auto& x = f.frames;
    const Config& c = f.agent.config;
    const Index hidden = c.memory_size;
    Matrix<double> out(8, x.shape.columns());
    for (Index b = 0; b < x.shape.batch; ++b) {
      Vector<double> h = x.start.h.col(b), memory = x.start.c.col(b);
      for (Index t = 0; t < x.shape.steps; ++t) {
        const Index n = x.shape.column(t, b);
        if (x.keep(0, n) == 0) h.setZero(), memory.setZero();
        const auto& s = f.missions[x.mission_of[static_cast<std::size_t>(n)]];
        const Matrix<double> encoding = encode(n);
        const Matrix<double> filtered = encoding * scale(n, encoding, s).asDiagonal();
        const auto& m = f.params.memory;
        Vector<double> z = m.input_weight * filtered.reshaped() + m.hidden_weight * h + m.bias;
        if (c.completion_input) z += f.params.completion * x.completion.col(n);
        memory = logistic(z.segment(hidden, hidden)).array() * memory.array() +
                 logistic(z.head(hidden)).array() * z.segment(2 * hidden, hidden).array().tanh();
        h = logistic(z.tail(hidden)).array() * memory.array().tanh();
        Vector<double> features(hidden + c.text_size);
        features << h, text(s);
        const auto head = [&](const auto& p) -> Vector<double> {
          return p.output.weight *
                     (p.hidden.weight * features + p.hidden.bias).array().tanh().matrix() +
                 p.output.bias;
        };
        out.col(n) << head(f.params.actor), head(f.params.critic);
      }
    }
    return out;
  }
};

struct AgentVariant : testing::TestWithParam<Config> {
  AgentFixture<double> f{GetParam()};
};

TEST_P(AgentVariant, EqualsItsPlainTwin) {
  f.forward();
  const Matrix<double> twin = PlainTwin{f}.run();
  EXPECT_TRUE(f.cache.logits().isApprox(twin.topRows(7), 1e-12));
  EXPECT_TRUE(f.cache.values().isApprox(twin.bottomRows(1), 1e-12));
}

TEST_P(AgentVariant, GradientsMatchCentralDifferences) {
  const Index n = f.frames.shape.columns();
  const Matrix<double> dlogits = random_matrix(7, n), dvalues = random_matrix(1, n);
  const Matrix<double> dmask = random_matrix(f.agent.config.task_words, n, 0.3);
  const auto loss = [&] {
    f.forward();
    double total =
        f.cache.logits().cwiseProduct(dlogits).sum() + f.cache.values().cwiseProduct(dvalues).sum();
    if (f.agent.config.task_attention) {
      // A loss on the logits of alpha, as L_TA is.
      const auto alpha = f.cache.task.alpha.array();
      total += ((alpha / (1 - alpha)).log() * dmask.array()).sum();
    }
    return total;
  };
  loss();
  auto grads = nn::zeros_like(f.params);
  auto dtables = f.agent.make_tables();
  if (f.agent.config.task_attention) f.cache.task.dlogits = dmask;
  f.agent.backward(f.params, f.tables, f.frames, f.missions, dlogits, dvalues, f.cache, grads,
                   dtables);
  f.agent.all_tables_backward(f.params, f.tables, dtables, grads);
  const nn::GradientError error = nn::check_gradients(f.params, grads, loss);
  EXPECT_LE(error.worst, 1e-6) << error.where;
}

TEST_P(AgentVariant, PaddingBehindAMissionChangesNothing) {
  f.forward();
  const Matrix<double> logits = f.cache.logits();
  const Matrix<double> values = f.cache.values();
  // A longer mission in the batch makes every other one padded; foreign words behind the end too.
  f.missions.index_of(test::sentence("pick up the red key and go to the red box after you"));
  for (auto& s : f.missions.sentences) {
    for (auto i = static_cast<std::size_t>(s.length); i < s.words.size(); ++i) s.words[i] = 17;
  }
  f.forward();
  // Sums over columns of another height may round differently: the last bit is free.
  EXPECT_TRUE(logits.isApprox(f.cache.logits(), 1e-14));
  EXPECT_TRUE(values.isApprox(f.cache.values(), 1e-14));
}

TEST_P(AgentVariant, AllocatesNothingAfterTheFirstPass) {
  AgentFixture<double> g(GetParam(), {4, 8});
  const Matrix<double> dlogits = Matrix<double>::Ones(7, 32), dvalues = Matrix<double>::Ones(1, 32);
  auto grads = nn::zeros_like(g.params);
  auto dtables = g.agent.make_tables();
  const auto pass = [&] {
    g.forward();
    if (g.agent.config.task_attention) g.cache.task.dlogits.setConstant(0.1);
    g.agent.backward(g.params, g.tables, g.frames, g.missions, dlogits, dvalues, g.cache, grads,
                     dtables);
    g.agent.all_tables_backward(g.params, g.tables, dtables, grads);
  };
  pass();
  Eigen::internal::set_is_malloc_allowed(false);
  pass();
  Eigen::internal::set_is_malloc_allowed(true);
}

INSTANTIATE_TEST_SUITE_P(Readings, AgentVariant,
                         testing::Values(variant(false, false), variant(true, false),
                                         variant(true, false, 1), variant(true, false, 3),
                                         variant(true, true), variant(true, true, 1),
                                         with_completion_input(), with_task_places(),
                                         with_patches(variant(false, false)),
                                         with_patches(variant(true, false)),
                                         with_patches(variant(true, true, 1))),
                         [](const auto& variant_info) {
                           const Config& c = variant_info.param;
                           return std::string(c.encoder == Encoder::patch ? "Patch" : "") +
                                  std::string(c.completion_input ? "CompletionInput"
                                              : c.task_places    ? "TaskPlaces"
                                              : c.task_attention ? "TaskAttention"
                                              : c.attention      ? "Attention"
                                                                 : "Baseline") +
                                  "P" + std::to_string(static_cast<int>(c.gaze_exponent));
                         });

TEST(Agent, AttentionIsADistribution) {
  AgentFixture<double> f(variant(true, true));
  f.forward();
  const auto& a = f.cache.attention;
  for (Index n = 0; n < f.frames.shape.columns(); ++n) {
    const int length = f.missions[f.frames.mission_of[static_cast<std::size_t>(n)]].length;
    for (int i = 0; i < length; ++i) {
      double sum = 0;
      for (Index c = 0; c < 49; ++c) sum += a.maps(f.agent.kind(f.frames.cells, c, n), a.map(n, i));
      EXPECT_NEAR(sum, 1, 1e-12);
    }
    EXPECT_NEAR(a.weights.col(n).sum(), 1, 1e-12);
    EXPECT_EQ(a.weights.col(n).tail(a.weights.rows() - length).cwiseAbs().sum(), 0);
    EXPECT_GT(f.cache.task.alpha.minCoeff(), 0);
    EXPECT_LT(f.cache.task.alpha.maxCoeff(), 1);
  }
}

TEST(Agent, SurvivesScoresFarBelowThoseOutOfView) {
  // The largest score of the table belongs to a code that no frame shows.
  AgentFixture<double> f(variant(true, false));
  f.forward();
  const int hidden_code = f.agent.alphabet.find({5, 0, 0});
  for (Index i = 0; i < f.frames.cells.size(); ++i) {
    if (f.frames.cells.data()[i] == hidden_code) f.frames.cells.data()[i] = 1;
  }
  f.tables.attention.scores.row(hidden_code).setConstant(1000);
  f.agent.forward(f.params, f.tables, f.frames, f.missions, f.agent.text(f.cache), f.cache);
  EXPECT_TRUE(f.cache.logits().allFinite());
  EXPECT_GT(f.cache.attention.scale.colwise().maxCoeff().minCoeff(), 0.99);
}

TEST(Agent, RefusesAMissionThatTheTaskModuleCannotHold) {
  Config c = variant(true, true);
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
