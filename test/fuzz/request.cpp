// Requests to a policy server: several messages in a row, each behind its length (two bytes, most
// significant first). What a server answers can be decoded; the same request again has the same
// answer.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fuzz.hpp"
#include "wordgaze/core/rng.hpp"
#include "wordgaze/lcm/convert.hpp"
#include "wordgaze/lcm/decode.hpp"
#include "wordgaze/policy/network_policy.hpp"

namespace {

using namespace wordgaze;

/// A small agent that reads all that a request holds.
policy::TrainedAgent small_agent() {
  model::Config config;
  config.channels = config.word_size = config.key_size = config.memory_size = 4;
  config.text_size = config.head_size = config.task_size = 4;
  config.task_attention = true;
  config.sub_tasks = 4;
  const policy::Agent agent(config, model::CellAlphabet::everything());
  core::Rng rng(1);
  return {{agent, agent.make_weights(agent.initialize(rng))}};
}

void check_reply(const policy::Reply& reply) {
  const auto bytes = lcm_io::encode(lcm_io::to_message(reply, 1));
  const auto message = lcm_io::decode<policy_reply_t>(bytes);
  fuzz::check(message.error.empty() == (message.action >= 0));
  fuzz::check(std::isfinite(message.value) && std::isfinite(message.nowhere));
  for (const char c : message.error) fuzz::check(c >= ' ' && c <= '~');
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto trained = small_agent();
  static policy::NetworkPolicy<policy::Agent> agent(trained);
  policy::Server server(agent, {.clients = 2});
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() >= 2) {
    const std::size_t length = std::size_t{rest[0]} << 8 | rest[1];
    const auto bytes = rest.subspan(2, std::min(length, rest.size() - 2));
    rest = rest.subspan(2 + bytes.size());
    fuzz::refused([&] {
      const auto message = lcm_io::decode<policy_request_t>(bytes);
      const auto request = lcm_io::to_request(message);
      lcm_io::encode(lcm_io::to_message(request, message.utime));
      const policy::Reply reply = server.answer(request);
      check_reply(reply);
      fuzz::check(server.answer(request) == reply);
      fuzz::check(server.clients() <= 2);
    });
  }
  return 0;
}
