// Traces to replay.
#include <sstream>

#include "fuzz.hpp"
#include "wordgaze/trace/replay.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  std::istringstream in{std::string(fuzz::text_of(data, size))};
  std::ostringstream details;
  fuzz::refused([&] { trace::replay(in, details); });
  return 0;
}
