#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wordgaze::core {

/// A seed of any size, as Python's non-negative integers.
class Seed {
 public:
  Seed(std::uint64_t value);  // NOLINT: a number is a seed
  /// At most 10,000 decimal digits. Throws std::invalid_argument for anything else (signs,
  /// fractions, nothing).
  static Seed parse(std::string_view digits);

  /// The decimal digits.
  std::string text() const;

  /// Digits in base 2^32, least significant first, without leading zeros; a single 0 for zero.
  std::span<const std::uint32_t> words() const { return words_; }

 private:
  std::vector<std::uint32_t> words_;
};

/// NumPy's default generator: PCG64 seeded by SeedSequence, with the integer, real and shuffle
/// draws of numpy.random.Generator, bit for bit. (docs/simulator.md, Random numbers)
class Rng {
 public:
  /// All there is to it; equal states go on identically.
  struct State {
    std::uint64_t state_high = 0, state_low = 0;
    std::uint64_t increment_high = 0, increment_low = 0;
    std::uint32_t half = 0;  ///< the upper half of a 64-bit draw whose lower half was used
    bool has_half = false;
    bool operator==(const State&) const = default;
  };

  explicit Rng(std::uint64_t seed = 0);
  explicit Rng(const Seed& seed);
  explicit Rng(const State& state);

  State state() const;

  std::uint64_t next64() {
    state_ = state_ * kMultiplier + increment_;
    const auto high = static_cast<std::uint64_t>(state_ >> 64);
    const auto low = static_cast<std::uint64_t>(state_);
    return std::rotr(high ^ low, static_cast<int>(high >> 58));
  }

  std::uint32_t next32() {
    if (has_half_) {
      has_half_ = false;
      return half_;
    }
    const std::uint64_t both = next64();
    half_ = static_cast<std::uint32_t>(both >> 32);
    has_half_ = true;
    return static_cast<std::uint32_t>(both);
  }

  /// Generator.integers(low, high): uniform in [low, high). A range of one value draws nothing.
  std::int64_t integer(std::int64_t low, std::int64_t high);

  /// integers(0, n) for the small n of the generators.
  int below(int n) {
    if (n == 1) return 0;
    const auto range = static_cast<std::uint32_t>(n);
    std::uint64_t product = std::uint64_t{next32()} * range;
    if (static_cast<std::uint32_t>(product) < range) [[unlikely]] {
      const std::uint32_t threshold = -range % range;
      while (static_cast<std::uint32_t>(product) < threshold) {
        product = std::uint64_t{next32()} * range;
      }
    }
    return static_cast<int>(product >> 32);
  }

  /// Generator.random(): uniform in [0, 1).
  double uniform() { return static_cast<double>(next64() >> 11) * 0x1p-53; }

  /// Generator.shuffle of a list, which draws its indices by masked rejection.
  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i-- > 1;) {
      std::swap(items[i], items[masked(static_cast<std::uint32_t>(i))]);
    }
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr Wide kMultiplier =
      (Wide{2549297995355413924u} << 64) | Wide{4865540595714422341u};

  void seed(std::span<const std::uint32_t> words);
  std::uint32_t masked(std::uint32_t highest);

  Wide state_ = 0, increment_ = 0;
  std::uint32_t half_ = 0;
  bool has_half_ = false;
};

}  // namespace wordgaze::core
