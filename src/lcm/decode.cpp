#include "wordgaze/lcm/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace wordgaze::lcm_io::detail {
namespace {

/// Walks through an encoded message without ever leaving it. Numbers are big-endian; a count stands
/// before its arrays; a string is its length with the final zero (4 bytes), the text and the zero.
class Walk {
 public:
  Walk(std::span<const std::uint8_t> bytes, std::string_view type) : rest_(bytes), type_(type) {}

  void skip(std::size_t size) { take(size); }
  void skip_array(std::size_t count, std::size_t size) {
    expect(count <= rest_.size() / size, "an array is longer than the message");
    take(count * size);
  }
  std::size_t count() {
    const std::uint32_t number = read_u32();
    expect(number <= static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()),
           "a count is negative");
    return number;
  }
  /// The same of a count that may be -1, for 0.
  std::size_t count_or_none() {
    if (rest_.size() < 4 || std::ranges::any_of(rest_.first(4), [](auto b) { return b != 0xFF; })) {
      return count();
    }
    skip(4);
    return 0;
  }
  std::size_t left() const { return rest_.size(); }
  void skip_string() {
    const std::size_t length = count();
    expect(length > 0, "a string has no end");
    expect(take(length).back() == 0, "a string has no end");
  }
  void skip_strings(std::size_t count) {
    for (; count > 0; --count) skip_string();
  }
  void fingerprint(std::int64_t hash) {
    const std::uint64_t high = read_u32();
    const std::uint64_t low = read_u32();
    expect((high << 32 | low) == static_cast<std::uint64_t>(hash), "its fingerprint is another");
  }
  void end() { expect(rest_.empty(), "there are bytes behind its end"); }

 private:
  void expect(bool ok, std::string_view otherwise) const {
    if (!ok) throw std::runtime_error(fmt::format("not a valid {}: {}", type_, otherwise));
  }
  std::span<const std::uint8_t> take(std::size_t size) {
    expect(size <= rest_.size(), "it is truncated");
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  std::uint32_t read_u32() {
    std::uint32_t number = 0;
    for (const std::uint8_t byte : take(4)) number = number << 8 | byte;
    return number;
  }

  std::span<const std::uint8_t> rest_;
  std::string_view type_;
};

template <class Message>
Walk begin(std::span<const std::uint8_t> bytes) {
  Walk walk(bytes, Message::getTypeName());
  walk.fingerprint(Message::getHash());
  return walk;
}

}  // namespace

// The fields in the order of lcmtypes/; tests compare the sizes with the encoder's.

void check(std::span<const std::uint8_t> bytes, const episode_begin_t*) {
  Walk walk = begin<episode_begin_t>(bytes);
  walk.skip(8 + 8 + 4);  // utime, episode_id, env_index
  walk.skip_string();    // env_id
  walk.skip(8);          // seed
  walk.skip_string();    // mission
  const std::size_t tokens = walk.count();
  walk.skip_strings(tokens);
  walk.skip_array(tokens, 4);  // token_ids
  walk.skip(4);                // max_steps
  walk.skip_strings(2);        // run_id, checkpoint
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const world_t*) {
  Walk walk = begin<world_t>(bytes);
  walk.skip(8 + 8 + 4 + 4 + 2 + 2);  // utime, episode_id, env_index, step, width, height
  walk.skip_array(walk.count(), 1);  // cells
  walk.skip(2 + 2 + 1 + 3);          // agent_x, agent_y, direction, carried
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const progress_t*) {
  Walk walk = begin<progress_t>(bytes);
  walk.skip(8 + 8 + 4 + 4);              // utime, episode_id, env_index, step
  walk.skip_array(walk.count(), 1 + 1);  // completed, enabled
  walk.skip_array(walk.count(), 1);      // sub_task_of
  walk.skip_array(walk.count(), 2 + 2);  // target_x, target_y
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const step_t*) {
  Walk walk = begin<step_t>(bytes);
  walk.skip(8 + 8 + 4 + 4);          // utime, episode_id, env_index, step
  walk.skip(147 + 1 + 2 + 2);        // image, direction, agent_x, agent_y
  walk.skip(1 + 4 + 4 + 4 + 1 + 1);  // action, value, entropy, reward, terminated, truncated
  walk.skip_array(walk.count(), 4);  // logits
  const std::size_t tokens = walk.count();
  walk.skip_array(tokens, 4 + 4 + 4 * 49);  // word_weights, word_mask, word_attention
  walk.skip(4 * 49);                        // attention_map
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const episode_end_t*) {
  Walk walk = begin<episode_end_t>(bytes);
  walk.skip(8 + 8 + 4 + 4 + 8 + 1 + 1);
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const metrics_t*) {
  Walk walk = begin<metrics_t>(bytes);
  walk.skip(8);        // utime
  walk.skip_string();  // run_id
  walk.skip(8 + 8);    // update, frames
  const std::size_t scalars = walk.count();
  walk.skip_strings(scalars);   // name
  walk.skip_array(scalars, 8);  // value
  walk.end();
}

void check(std::span<const std::uint8_t> bytes, const policy_reply_t*) {
  Walk walk = begin<policy_reply_t>(bytes);
  walk.skip(8 + 8 + 8);              // utime, client_id, seq
  walk.skip_string();                // error
  walk.skip(1);                      // action
  walk.skip_array(walk.count(), 4);  // probabilities
  walk.skip(4);                      // value
  const std::size_t tokens = walk.count();
  walk.skip_strings(tokens);
  walk.skip_array(tokens, 4 + 4);  // word_weights, word_mask
  walk.skip(4 * 49 + 4);           // attention_map, nowhere
  walk.end();
}

namespace {

/// Checks a request, and gives back where the number of completions stands.
std::size_t place_of_completions(std::span<const std::uint8_t> bytes) {
  Walk walk = begin<policy_request_t>(bytes);
  walk.skip(8 + 8 + 8 + 1);  // utime, client_id, seq, reset
  walk.skip_string();        // mission
  walk.skip(147 + 1);        // image, direction
  const std::size_t place = bytes.size() - walk.left();
  walk.skip_array(walk.count_or_none(), 1);  // completion
  walk.end();
  return place;
}

}  // namespace
}  // namespace wordgaze::lcm_io::detail

template <>
wordgaze::policy_request_t wordgaze::lcm_io::decode<wordgaze::policy_request_t>(
    std::span<const std::uint8_t> bytes) {
  const std::size_t place = detail::place_of_completions(bytes);
  std::vector<std::uint8_t> plain(bytes.begin(), bytes.end());
  if (plain[place] == 0xFF) std::fill_n(plain.begin() + static_cast<std::ptrdiff_t>(place), 4, 0);
  policy_request_t message{};
  if (message.decode(plain.data(), 0, static_cast<int>(plain.size())) < 0) {
    throw std::runtime_error("cannot decode policy_request_t");
  }
  return message;
}
