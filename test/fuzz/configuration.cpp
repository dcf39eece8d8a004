// Configurations as TOML. What is read is written as TOML that reads back the same.
#include "fuzz.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/training/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  const auto text = fuzz::text_of(data, size);
  fuzz::refused([&] {
    const auto config = io::parse_config<training::TrainConfig>(text, "fuzz");
    const auto again = io::parse_config<training::TrainConfig>(io::to_toml(config), "again");
    fuzz::check(io::differences(config, again).empty());
    training::validate(config);
  });
  return 0;
}
