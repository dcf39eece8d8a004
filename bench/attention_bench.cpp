// Text-visual attention over 640 views of a room with four objects, one mission of five words.
#include <benchmark/benchmark.h>

#include "wordgaze/env/environment.hpp"
#include "wordgaze/model/text_visual_attention.hpp"
#include "wordgaze/rl/actor.hpp"
#include "wordgaze/rl/alphabet.hpp"

namespace {

using namespace wordgaze;
using Layer = model::TextVisualAttention<float>;

constexpr Index kFrames = 640, kKeySize = 16, kChannels = 16;
constexpr float kSharpness = 0.257f, kExponent = 2, kFloor = 0.1f;

struct Attention : benchmark::Fixture {
  model::CellMatrix cells{grid::kViewCells, kFrames};
  model::Missions missions;
  std::vector<int> mission_of = std::vector<int>(kFrames, 0);
  Layer::Tables tables, dtables;
  Layer::Cache cache;
  Matrix<float> alpha, dalpha, dscale;

  Attention() {
    env::Environment environment("Wordgaze-One-N8-K4-v0");
    const rl::Agent agent{model::Config{}, rl::alphabet_of(environment.spec())};
    const auto& alphabet = agent.alphabet;
    const Index kinds = agent.kinds();
    std::array<std::uint8_t, grid::kImageBytes> image;
    for (Index n = 0; n < kFrames; ++n) {
      environment.reset(n);
      environment.observe(image);
      alphabet.encode(
          image, std::span<std::uint8_t, grid::kViewCells>(cells.col(n).data(), grid::kViewCells));
    }
    missions.index_of(environment.sentence());
    tables.resize(kKeySize, kChannels, babyai::kVocabularySize, kinds);
    tables.scores.setRandom();
    dtables = tables;
    cache.resize(kinds, kFrames, missions.longest);
    alpha.setOnes(missions.longest, kFrames);
    dalpha = alpha;
    dscale = Matrix<float>::Random(kinds, kFrames);
  }
  void forward() {
    Layer::count_codes(cells, cache);
    Layer::forward_words([&](Index, Index, Index word) { return tables.scores.col(word); },
                         missions, mission_of, kSharpness, cache);
    Layer::forward_gaze(missions, mission_of, alpha, kExponent, kFloor, cache);
  }
};

BENCHMARK_F(Attention, forward)(benchmark::State& state) {
  for (auto _ : state) forward();
  state.SetItemsProcessed(state.iterations() * kFrames);
}

BENCHMARK_F(Attention, backward)(benchmark::State& state) {
  forward();
  for (auto _ : state) {
    Layer::backward_gaze(missions, mission_of, alpha, kExponent, kFloor, dscale, cache, dalpha);
    Layer::backward_words(
        missions, mission_of, alpha, kSharpness, cache,
        [&](Index, Index, Index word, const auto& dscore) { dtables.scores.col(word) += dscore; });
  }
  state.SetItemsProcessed(state.iterations() * kFrames);
}

}  // namespace
