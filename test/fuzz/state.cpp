// Checkpoints of a training run in which bytes of any tensor were changed and the checksum made
// right: refused, or the run goes on with finite numbers.
#include <cmath>
#include <cstring>
#include <iterator>

#include "fuzz.hpp"
#include "wordgaze/training/checkpoint.hpp"

namespace {

using namespace wordgaze;

training::TrainConfig tiny() {
  training::TrainConfig config;
  config.env = "Wordgaze-Two-N8-K4-v0";
  config.frames = 4096;
  config.model.task_attention = true;
  config.model.channels = config.model.word_size = config.model.key_size = 4;
  config.model.memory_size = config.model.text_size = config.model.head_size = 4;
  config.ppo.lanes = 2;
  config.ppo.steps = 8;
  config.ppo.chunk = 4;
  config.ppo.minibatches = 2;
  config.ppo.epochs = 1;
  return config;
}

/// A run that has begun, and its checkpoint.
struct Run {
  training::Trainer trainer{tiny()};
  io::TensorMap map;
  Run() {
    trainer.update();
    const auto path = fuzz::scratch_file();
    training::save_checkpoint(path, trainer.config(), trainer.state());
    map = io::read_safetensors(path);
    std::filesystem::remove(path);
  }
};

}  // namespace

/// Each six bytes are a change: tensor, place (four bytes), value.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Run run;
  static const auto path = fuzz::scratch_file();
  io::TensorMap map = run.map;
  for (; size >= 6; data += 6, size -= 6) {
    auto& tensor = std::next(map.tensors.begin(), data[0] % map.tensors.size())->second;
    std::uint32_t place = 0;
    std::memcpy(&place, data + 1, sizeof place);
    std::visit(
        [&](auto& values) {
          const std::size_t bytes = values.size() * sizeof(values[0]);
          if (bytes > 0) reinterpret_cast<std::uint8_t*>(values.data())[place % bytes] = data[5];
        },
        tensor.values);
  }
  io::write_safetensors(path, map);
  fuzz::refused([&] {
    training::Trainer trainer(tiny());
    trainer.restore(training::load_state<policy::Agent>(path, trainer));
    for (int i = 0; i < 2; ++i) trainer.update();
  });
  std::filesystem::remove(path);
  return 0;
}
