#include <gtest/gtest.h>

#include "model/agent_fixture.hpp"
#include "model/golden_agent.hpp"

/// The agent against PyTorch, which computes it with dense cells and differentiates it by itself
/// (scripts/golden/agent.py).
namespace wordgaze::model {
namespace {

using test::Json;
using test::relative_error;

constexpr double kTolerance = 1e-9;

/// The agent of a golden file, with its inputs and its weights.
struct Reference {
  Json json;
  Agent<double> agent;
  Agent<double>::Weights weights;
  Agent<double>::Cache cache;
  Outputs<double> outputs;
  Frames<double> frames;
  Missions missions;

  explicit Reference(const std::string& name)
      : json(test::golden("model/" + name + ".json")),
        agent{test::config_of(json.at("config")), CellAlphabet::one_room()},
        weights(agent.make_weights()) {
    test::read_parameters(json.at("parameters"), weights.params);
    frames.resize(agent.config, {json.at("steps"), json.at("lanes")});
    for (Index n = 0; n < frames.shape.columns(); ++n) read_frame(n);
    for (Index b = 0; b < frames.shape.batch; ++b) {
      const auto lane = static_cast<std::size_t>(b);
      frames.start.h.col(b) = test::column(json.at("start").at("h").at(lane));
      frames.start.c.col(b) = test::column(json.at("start").at("c").at(lane));
    }
    agent.refresh(weights);
    Matrix<double> text(mission_features(agent.config), missions.size());
    agent.encode_text(weights, missions, cache, text);
    agent.forward(weights, frames, missions, text, cache, outputs);
  }

  void read_frame(Index n) {
    const Json& frame = json.at("frames").at(static_cast<std::size_t>(n));
    std::array<std::uint8_t, grid::kImageBytes> image;
    auto byte = image.begin();
    for (const auto& cell : frame.at("image")) byte = std::copy(cell.begin(), cell.end(), byte);
    agent.alphabet.encode(image, std::span<std::uint8_t, grid::kViewCells>(
                                     frames.cells.col(n).data(), grid::kViewCells));
    frames.keep(0, n) = frame.at("keep");
    frames.completion.col(n) = test::column(frame.at("completion"));
    Mission mission;
    for (const int word : json.at("missions").at(frame.at("mission").get<std::size_t>())) {
      mission.append(static_cast<babyai::WordId>(word), 0);
    }
    for (std::size_t i = 0; scans(agent.config) && i < frame.at("completion").size(); ++i) {
      mission.done[i] = frame.at("completion").at(i).get<int>() > 0;
    }
    frames.mission_of[static_cast<std::size_t>(n)] = missions.index_of(mission);
  }

  const Json& result(Index n) const { return json.at("results").at(static_cast<std::size_t>(n)); }

  /// What the loss asks of an output: one column a frame.
  Matrix<double> asked(const char* output) const {
    const Json& list = json.at("asked").at(output);
    const Index size = list.at(0).is_number() ? 1 : static_cast<Index>(list.at(0).size());
    const auto count = static_cast<Index>(list.size());
    return test::matrix(list, count, size).transpose();
  }

  /// One number an entry as one a cell of frame n.
  Vector<double> over_cells(Index n, const Matrix<double>& by_entry, Index column) const {
    Vector<double> map(grid::kViewCells);
    for (Index c = 0; c < grid::kViewCells; ++c)
      map(c) = by_entry(agent.entry(frames.cells, c, n), column);
    return map;
  }
};

struct ReferenceGolden : testing::TestWithParam<const char*> {
  Reference f{GetParam()};

  Index count() const { return f.frames.shape.columns(); }
};

/// Those that look: the baselines have no maps to compare.
struct ReferenceGaze : ReferenceGolden {};

TEST_P(ReferenceGolden, AgreesOnLogitsValuesAndMemory) {
  for (Index n = 0; n < count(); ++n) {
    const Json& theirs = f.result(n);
    EXPECT_LE(relative_error(f.outputs.logits.col(n), test::column(theirs.at("logits"))),
              kTolerance);
    EXPECT_NEAR(f.outputs.values(0, n), theirs.at("value"), kTolerance);
    EXPECT_LE(relative_error(f.cache.features.col(n).head(f.agent.config.memory_size),
                             test::column(theirs.at("h"))),
              kTolerance);
    EXPECT_LE(relative_error(f.cache.memory.cell.col(n), test::column(theirs.at("c"))), kTolerance);
  }
}

TEST_P(ReferenceGaze, AgreesOnWhereItLooks) {
  const auto& ours = f.cache.attention;
  for (Index n = 0; n < count(); ++n) {
    const Json& theirs = f.result(n);
    const auto words = static_cast<Index>(theirs.at("maps").size());
    for (Index i = 0; i < words; ++i) {
      EXPECT_LE(relative_error(f.over_cells(n, ours.maps, ours.map(n, i)),
                               test::column(theirs.at("maps").at(static_cast<std::size_t>(i)))),
                kTolerance);
    }
    const auto agrees = [&](const char* name, const Matrix<double>& columns) {
      EXPECT_LE(relative_error(columns.col(n).head(words), test::column(theirs.at(name))),
                kTolerance)
          << name << " of frame " << n;
    };
    agrees("entropy", ours.entropy);
    agrees("weights", ours.weights);
    if (f.agent.config.task_attention) agrees("alpha", f.cache.alpha);
    EXPECT_LE(relative_error(f.over_cells(n, ours.gaze, n), test::column(theirs.at("gaze"))),
              kTolerance);
    EXPECT_LE(relative_error(f.over_cells(n, ours.scale, n), test::column(theirs.at("scale"))),
              kTolerance);
  }
}

TEST_P(ReferenceGolden, AgreesOnTheGradientOfEveryParameter) {
  auto grads = f.agent.make_gradients(1);
  nn::set_zero(grads.front());
  Outputs<double> asked{f.asked("logits"), f.asked("value"), Matrix<double>(0, count())};
  if (f.agent.config.task_attention) asked.mask = f.asked("mask_logits");
  f.agent.backward(f.weights, f.frames, f.missions, f.outputs, asked, f.cache, grads.front());
  Team team(1);
  f.agent.reduce(f.weights, grads, team);
  int leaves = 0;
  nn::for_each_parameter(
      [&](const nn::Path& path, const auto& ours) {
        // A number that training sets: nothing is asked of it.
        if (ours.size() == 0 || path.str() == "attention.focus") return;
        ++leaves;
        const Json& theirs = f.json.at("gradients").at(path.str());
        EXPECT_LE(relative_error(ours, test::matrix(theirs, ours.rows(), ours.cols())), kTolerance)
            << path.str();
      },
      grads.front().params);
  EXPECT_EQ(leaves, static_cast<int>(f.json.at("gradients").size()));
}

INSTANTIATE_TEST_SUITE_P(PyTorch, ReferenceGolden,
                         testing::Values("baseline", "attention_p1", "attention_p2",
                                         "task_attention", "attention_3x3", "baseline_3x3",
                                         "product", "product_focused", "product_task_sum",
                                         "product_task_scan"),
                         [](const auto& variant) { return std::string(variant.param); });
INSTANTIATE_TEST_SUITE_P(PyTorch, ReferenceGaze,
                         testing::Values("attention_p1", "attention_p2", "task_attention",
                                         "attention_3x3", "product", "product_focused",
                                         "product_task_sum", "product_task_scan"),
                         [](const auto& variant) { return std::string(variant.param); });

}  // namespace
}  // namespace wordgaze::model
