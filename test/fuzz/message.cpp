// Bytes from a log or the network as each of the LCM messages. What is decoded is encoded to the
// same bytes.
#include <algorithm>

#include "fuzz.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"

namespace {

template <class Message>
void decode(std::span<const std::uint8_t> bytes) {
  using namespace wordgaze;
  fuzz::refused([&] {
    const auto message = lcm_io::decode<Message>(bytes);
    fuzz::check(message.getEncodedSize() == static_cast<int>(bytes.size()));
    lcm_io::encode(message);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(data, size);
  decode<wordgaze::episode_begin_t>(bytes);
  decode<wordgaze::world_t>(bytes);
  decode<wordgaze::progress_t>(bytes);
  decode<wordgaze::step_t>(bytes);
  decode<wordgaze::episode_end_t>(bytes);
  decode<wordgaze::metrics_t>(bytes);
  decode<wordgaze::policy_reply_t>(bytes);
  return 0;
}
