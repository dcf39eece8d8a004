// Names of environments: what is known makes a world.
#include "fuzz.hpp"
#include "wordgaze/env/environment.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  fuzz::refused([&] {
    env::Environment environment{std::string(fuzz::text_of(data, size))};
    environment.reset(1);
  });
  return 0;
}
