#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "wordgaze/grid/cell.hpp"

/// What a BabyAI mission asks for.
namespace wordgaze::babyai {

enum class Verb : std::uint8_t { go_to, pickup, open, put_next };

/// Where an object is, as seen from the agent when the episode begins.
enum class Location : std::uint8_t { anywhere, left, right, front, behind };

/// Which objects a phrase means: "a red ball on your left", "the object behind you".
struct Description {
  std::optional<grid::Type> type{};    ///< none: "object"
  std::optional<grid::Color> color{};  ///< none: any
  Location location = Location::anywhere;

  bool operator==(const Description&) const = default;
};

/// "go to D", "pick up D", "open D", "put D next to E".
struct Clause {
  Verb verb = Verb::go_to;
  Description object{};
  Description next_to{};  ///< put_next only
  /// The wrong door opened or the wrong object picked up is a failure.
  bool strict = false;

  bool operator==(const Clause&) const = default;
};

/// In which order the two parts of an instruction are to be done.
enum class Order : std::uint8_t {
  any,     ///< one part only
  before,  ///< "A, then B"
  after,   ///< "A after you B": B comes first
};

/// One clause, two joined by "and", or two such parts in an order. At most four clauses, in the
/// order of the sentence; a flat value instead of a tree.
struct Instruction {
  static constexpr int kMaxClauses = 4;

  std::array<Clause, kMaxClauses> clause{};
  std::uint8_t first_part = 0;   ///< clauses of part A: 1 or 2
  std::uint8_t second_part = 0;  ///< clauses of part B: 0 without an order, else 1 or 2
  Order order = Order::any;
  bool strict = false;  ///< with an order: doing the later part first is a failure

  /// Clauses [begin, end) of one part.
  struct Part {
    int begin = 0, end = 0;
    int size() const { return end - begin; }
  };

  int clauses() const { return first_part + second_part; }
  /// The part to be done first, and the other one (empty without an order).
  Part earlier() const { return order == Order::after ? part_b() : part_a(); }
  Part later() const { return order == Order::after ? part_a() : part_b(); }

  Part part_a() const { return {0, first_part}; }
  Part part_b() const { return {first_part, clauses()}; }

  bool operator==(const Instruction&) const = default;
};

/// "A"
Instruction single(const Clause& a);
/// "A and B"
Instruction both(const Clause& a, const Clause& b);
/// "A, then B" or "A after you B"; both parts without an order of their own.
Instruction ordered(const Instruction& a, Order order, const Instruction& b);

}  // namespace wordgaze::babyai
