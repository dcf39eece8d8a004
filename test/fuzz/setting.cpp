// Settings of the command line, "key=value", one a line.
#include "fuzz.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/training/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  auto text = fuzz::text_of(data, size);
  training::TrainConfig config;
  while (!text.empty()) {
    const auto line = text.substr(0, text.find('\n'));
    fuzz::refused([&] { io::set_option(config, line); });
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  fuzz::refused([&] { training::validate(config); });
  return 0;
}
