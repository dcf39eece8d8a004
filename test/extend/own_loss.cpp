// An own term of the loss: large logits cost something.
#include <array>
#include <cstdio>
#include <memory>

#include <wordgaze/training/trainer.hpp>

using namespace wordgaze;

class SmallLogits final : public training::Loss {
 public:
  explicit SmallLogits(float coefficient) : coefficient_(coefficient) {}
  std::span<const std::string_view> reports() const override { return kReports; }
  void add(const training::Batch&, const model::Outputs<float>& outputs, const training::Rates&,
           float scale, model::Outputs<float>& gradient, std::span<double> sums) const override {
    gradient.logits += 2 * coefficient_ * scale * outputs.logits;
    sums[0] += static_cast<double>(outputs.logits.squaredNorm());
  }

 private:
  static constexpr std::array<std::string_view, 1> kReports{"squared_logits"};
  float coefficient_;
};

double squared_logits(float coefficient) {
  training::TrainConfig config;
  config.env = "Wordgaze-One-N5-K2-auto-v0";
  config.frames = 30'000;
  config.threads = 1;
  training::Trainer trainer(config);
  trainer.add_loss(std::make_unique<SmallLogits>(coefficient));
  training::Metrics metrics;
  while (!trainer.finished()) metrics = trainer.update();
  std::printf("coefficient %.1f: %s %.4f, in column %zu of metrics.csv\n",
              static_cast<double>(coefficient), metrics.others.at(0).first.c_str(),
              metrics.others.at(0).second, trainer.columns().size());
  return metrics.others.at(0).second;
}

int main() { return squared_logits(1) < 0.5 * squared_logits(0) ? 0 : 1; }
