// An own vision block: a cell is encoded by what lies in it and by where it lies in the view.
#include <cstdio>

#include <wordgaze/training/trainer.hpp>

using namespace wordgaze;

template <class S>
struct PlaceEncoder : model::PlainMapEncoder<S> {
  using typename model::PlainMapEncoder<S>::Tables, typename model::PlainMapEncoder<S>::Cache;
  using model::PlainMapEncoder<S>::resize;
  struct Params {
    Matrix<S> weight;  // [C, 20 + 49]: a column a feature of the content, then one a place
    static constexpr auto fields() { return std::tuple{nn::Field{"places", &Params::weight}}; }
  };
  static void resize(const model::Design& d, Params& p) {
    p.weight.resize(d.config.channels, model::kCellFeatures + grid::kViewCells);
  }
  static void initialize(const model::Design&, core::Rng& rng, Params& p) {
    nn::fill_uniform(p.weight, 0.5, rng);
  }
  static void set_object_channel(const model::Design&, Params& p) {
    p.weight.row(0).setZero();
    p.weight.row(0).segment(model::kFirstObject, model::kObjectTypes).setOnes();
  }
  static void forward(const model::Design& d, const Params& p, const Tables&,
                      const model::CellMatrix& cells, Cache& k) {
    for_each_column(d, cells, k.output, [&](auto y, Index column, bool first) {
      y = p.weight.col(column) + (first ? S(0) : S(1)) * y;
    });
  }
  static void backward(const model::Design& d, const Params&, const Tables&,
                       const model::CellMatrix& cells, Cache& k, Params& grads, Tables&) {
    for_each_column(d, cells, k.doutput,
                    [&](auto dy, Index column, bool) { grads.weight.col(column) += dy; });
  }
  template <class F>
  static void for_each_column(const model::Design& d, const model::CellMatrix& cells,
                              Matrix<S>& map, F&& f) {
    for (Index i = 0; i < cells.size(); ++i) {
      const Index n = i / grid::kViewCells, c = i % grid::kViewCells;
      const auto cell = [&] { return model::map_frame(map, n).col(model::map_slot(c)); };
      f(cell(), model::kCellFeatures + c, true);
      for (const int row : model::features(d.alphabet[cells(c, n)])) f(cell(), row, false);
    }
  }
};

using OwnAgent = model::Agent<float, model::MapVision<float, PlaceEncoder>>;

int main() {
  training::TrainConfig config{.env = "Wordgaze-One-N5-K2-auto-v0"};
  training::BasicTrainer<OwnAgent> trainer(config);
  const Matrix<float> before = trainer.params().vision.weight;
  trainer.update();
  const float moved = (trainer.params().vision.weight - before).rightCols(grid::kViewCells).norm();
  std::printf("what places mean has moved by %.3f\n", static_cast<double>(moved));
  return moved > 0 ? 0 : 1;
}
