#include "wordgaze/babyai/instruction.hpp"

#include <algorithm>

#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {

bool is_grammatical(const Instruction& instruction) {
  if (instruction.count > Instruction::kMaxClauses) return false;
  int afters = 0;
  Order last = Order::before;
  for (int k = 1; k < instruction.count; ++k) {
    const Order order = instruction.order[k];
    if (order > Order::after || (order == Order::any && last == Order::any)) return false;
    afters += order == Order::after;
    last = order;
  }
  return afters <= 1;
}

Instruction single(const Clause& a) { return {.clause = {a}, .count = 1}; }

Instruction both(const Clause& a, const Clause& b) { return {.clause = {a, b}, .count = 2}; }

Instruction ordered(const Instruction& a, Order order, const Instruction& b) {
  require(order != Order::any && a.count > 0 && b.count > 0 && a.behind_after() == 0 &&
              b.behind_after() == 0,
          "ordered instruction: expected an order of two sequences, both without \"after you\"");
  require(a.count + b.count <= Instruction::kMaxClauses,
          "ordered instruction: {} clauses; expected at most {}", a.count + b.count,
          Instruction::kMaxClauses);
  Instruction joined = a;
  std::copy_n(b.clause.begin(), b.count, joined.clause.begin() + a.count);
  std::copy_n(b.order.begin(), b.count, joined.order.begin() + a.count);
  joined.order[a.count] = order;
  joined.count = static_cast<std::uint8_t>(a.count + b.count);
  return joined;
}

}  // namespace wordgaze::babyai
