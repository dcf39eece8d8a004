#include "wordgaze/core/rng.hpp"

#include <array>
#include <limits>

#include "wordgaze/core/require.hpp"

namespace wordgaze::core {

Seed::Seed(std::uint64_t value) : words_{static_cast<std::uint32_t>(value)} {
  if (value >> 32 != 0) words_.push_back(static_cast<std::uint32_t>(value >> 32));
}

namespace {
constexpr std::size_t kMostDigits = 10'000;  // the work grows with their square
}

Seed Seed::parse(std::string_view digits) {
  require(!digits.empty() && digits.find_first_not_of("0123456789") == digits.npos,
          "seed '{}': expected a non-negative integer in decimal digits", shortened(digits));
  require(digits.size() <= kMostDigits, "seed '{}': expected at most {} digits", shortened(digits),
          kMostDigits);
  Seed seed(0);
  for (char digit : digits) {
    std::uint64_t carry = static_cast<std::uint64_t>(digit - '0');
    for (std::uint32_t& word : seed.words_) {
      carry += std::uint64_t{word} * 10;
      word = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) seed.words_.push_back(static_cast<std::uint32_t>(carry));
  }
  return seed;
}

std::string Seed::text() const {
  std::string digits;
  std::vector<std::uint32_t> rest = words_;
  while (!rest.empty()) {
    std::uint64_t remainder = 0;
    for (auto word = rest.rbegin(); word != rest.rend(); ++word) {
      remainder = remainder << 32 | *word;
      *word = static_cast<std::uint32_t>(remainder / 10);
      remainder %= 10;
    }
    digits.insert(digits.begin(), static_cast<char>('0' + remainder));
    while (!rest.empty() && rest.back() == 0) rest.pop_back();
  }
  return digits;
}

namespace {

// numpy.random.SeedSequence: a pool of four words, mixed from the words of the seed.
class SeedSequence {
 public:
  explicit SeedSequence(std::span<const std::uint32_t> entropy) {
    constexpr std::size_t n = kWords;
    for (std::size_t i = 0; i < n; ++i) pool_[i] = hash(i < entropy.size() ? entropy[i] : 0);
    for (std::size_t from = 0; from < n; ++from) {
      for (std::size_t to = 0; to < n; ++to) {
        if (from != to) pool_[to] = mix(pool_[to], hash(pool_[from]));
      }
    }
    for (std::size_t from = n; from < entropy.size(); ++from) {
      for (std::uint32_t& word : pool_) word = mix(word, hash(entropy[from]));
    }
  }

  // The first four 64-bit words of its output.
  std::array<std::uint64_t, 4> generate() const {
    std::array<std::uint64_t, 4> out{};
    std::uint32_t multiplier = 0x8b51f9dd;
    for (std::size_t i = 0; i < 2 * out.size(); ++i) {
      std::uint32_t v = pool_[i % kWords] ^ multiplier;
      multiplier *= 0x58f38ded;
      v *= multiplier;
      v ^= v >> 16;
      out[i / 2] |= std::uint64_t{v} << (i % 2 * 32);
    }
    return out;
  }

 private:
  static constexpr std::size_t kWords = 4;

  std::uint32_t hash(std::uint32_t v) {
    v ^= multiplier_;
    multiplier_ *= 0x931e8875;
    v *= multiplier_;
    return v ^ (v >> 16);
  }
  static std::uint32_t mix(std::uint32_t x, std::uint32_t y) {
    const std::uint32_t v = 0xca01f9dd * x - 0x4973f715 * y;
    return v ^ (v >> 16);
  }

  std::uint32_t multiplier_ = 0x43b0d7e5;
  std::array<std::uint32_t, kWords> pool_{};
};

}  // namespace

Rng::Rng(std::uint64_t value) {
  const std::array words{static_cast<std::uint32_t>(value),
                         static_cast<std::uint32_t>(value >> 32)};
  seed(std::span(words).first(words[1] == 0 ? 1 : 2));
}

Rng::Rng(const Seed& value) { seed(value.words()); }

Rng::Rng(const State& s)
    : state_(Wide{s.state_high} << 64 | s.state_low),
      increment_(Wide{s.increment_high} << 64 | s.increment_low),
      half_(s.half),
      has_half_(s.has_half) {}

Rng::State Rng::state() const {
  return {static_cast<std::uint64_t>(state_ >> 64),
          static_cast<std::uint64_t>(state_),
          static_cast<std::uint64_t>(increment_ >> 64),
          static_cast<std::uint64_t>(increment_),
          has_half_ ? half_ : 0,  // a half that was used is no part of the state
          has_half_};
}

void Rng::seed(std::span<const std::uint32_t> words) {
  const auto w = SeedSequence(words).generate();
  increment_ = (Wide{w[2]} << 64 | w[3]) << 1 | 1;
  state_ = increment_;  // one step from 0
  state_ += Wide{w[0]} << 64 | w[1];
  state_ = state_ * kMultiplier + increment_;
}

std::int64_t Rng::integer(std::int64_t low, std::int64_t high) {
  require(low < high, "Rng::integer: the range [{}, {}) is empty", low, high);
  const auto from = static_cast<std::uint64_t>(low);
  const std::uint64_t width = static_cast<std::uint64_t>(high) - 1 - from;  // inclusive
  constexpr std::uint64_t kWidest32 = std::numeric_limits<std::uint32_t>::max();
  if (width == 0) return low;
  std::uint64_t drawn = 0;
  if (width == kWidest32) {
    drawn = next32();
  } else if (width < kWidest32) {
    // Lemire's method on 32 bits, as in below().
    const auto range = static_cast<std::uint32_t>(width + 1);
    std::uint64_t product = std::uint64_t{next32()} * range;
    const std::uint32_t threshold = -range % range;
    while (static_cast<std::uint32_t>(product) < threshold) {
      product = std::uint64_t{next32()} * range;
    }
    drawn = product >> 32;
  } else {
    const std::uint64_t range = width + 1;  // not 2^64: an int64 range is narrower
    Wide product = Wide{next64()} * range;
    const std::uint64_t threshold = -range % range;
    while (static_cast<std::uint64_t>(product) < threshold) product = Wide{next64()} * range;
    drawn = static_cast<std::uint64_t>(product >> 64);
  }
  return static_cast<std::int64_t>(from + drawn);
}

std::uint32_t Rng::masked(std::uint32_t highest) {
  const std::uint32_t mask = std::bit_ceil(highest + 1) - 1;
  std::uint32_t drawn = next32() & mask;
  while (drawn > highest) drawn = next32() & mask;
  return drawn;
}

}  // namespace wordgaze::core
