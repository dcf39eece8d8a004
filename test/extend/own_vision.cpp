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
    for_each_column(
        d, cells, k.output, [&](auto y) { y.setZero(); },
        [&](auto y, Index column) { y += p.weight.col(column); });
  }
  static void backward(const model::Design& d, const Params&, const Tables&,
                       const model::CellMatrix& cells, Cache& k, Params& grads, Tables&) {
    for_each_column(
        d, cells, k.doutput, [](auto) {},
        [&](auto dy, Index column) { grads.weight.col(column) += dy; });
  }
  template <class Begin, class F>
  static void for_each_column(const model::Design& d, const model::CellMatrix& cells,
                              Matrix<S>& map, Begin&& begin, F&& f) {
    for (Index n = 0; n < cells.cols(); ++n) {
      for (Index c = 0; c < grid::kViewCells; ++c) {
        const auto cell = [&] { return model::map_frame(map, n).col(model::map_slot(c)); };
        begin(cell());
        f(cell(), model::kCellFeatures + c);
        for (const int row : model::features(d.alphabet[cells(c, n)])) f(cell(), row);
      }
    }
  }
};

using OwnAgent = model::Agent<float, model::MapVision<float, PlaceEncoder>>;

int main() {
  training::TrainConfig config;
  config.env = "Wordgaze-One-N5-K2-auto-v0";
  config.frames = 5000;
  training::BasicTrainer<OwnAgent> trainer(config);
  const Matrix<float> before = trainer.params().vision.weight;
  while (!trainer.finished()) trainer.update();
  const auto moved = (trainer.params().vision.weight - before).rightCols(grid::kViewCells).norm();
  std::printf("what places mean has moved by %.3f\n", static_cast<double>(moved));
  return moved > 0 ? 0 : 1;
}
