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

/// How a clause is joined to the one before it, and so which of them is done first.
enum class Order : std::uint8_t {
  any,     ///< "A and B"
  before,  ///< "A, then B"
  after,   ///< "A after you B": B comes first, with all that stands behind it
};

/// Clauses in the order of the sentence; a flat value instead of a tree:
///
///     mission  := sequence | sequence "after you" sequence
///     sequence := part | part ", then" sequence
///     part     := clause | clause "and" clause
struct Instruction {
  static constexpr int kMaxClauses = 8;

  std::array<Clause, kMaxClauses> clause{};
  std::array<Order, kMaxClauses> order{};  ///< of a clause and the one before it; [0] means nothing
  std::uint8_t count = 0;                  ///< of clauses
  bool strict = false;                     ///< with an order: doing a later part first is a failure

  /// Clauses [begin, end) of one part.
  struct Part {
    int begin = 0, end = 0;
    int size() const { return end - begin; }
  };

  int clauses() const { return count; }

  /// The part that begins with a clause.
  Part part_at(int begin) const {
    int end = begin < count ? begin + 1 : begin;
    while (end < count && order[end] == Order::any) ++end;
    return {begin, end};
  }
  /// The clause behind "after you"; 0 without one.
  int behind_after() const {
    for (int k = 1; k < count; ++k) {
      if (order[k] == Order::after) return k;
    }
    return 0;
  }
  /// The parts in the order in which they are to be done; an empty one behind the last.
  Part first() const { return part_at(behind_after()); }
  Part next(Part part) const {
    if (part.end < count) return order[part.end] == Order::before ? part_at(part.end) : Part{};
    const int start = behind_after();
    return start > 0 && part.begin >= start ? part_at(0) : Part{};
  }

  bool operator==(const Instruction&) const = default;
};

/// Whether the clauses are joined as the grammar has it.
bool is_grammatical(const Instruction& instruction);

/// "A"
Instruction single(const Clause& a);
/// "A and B"
Instruction both(const Clause& a, const Clause& b);
/// "A, then B" or "A after you B", of parts or sequences. Throws std::invalid_argument where the
/// grammar has no such instruction.
Instruction ordered(const Instruction& a, Order order, const Instruction& b);

}  // namespace wordgaze::babyai
