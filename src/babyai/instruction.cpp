#include "wordgaze/babyai/instruction.hpp"

#include <algorithm>

#include "wordgaze/core/require.hpp"

namespace wordgaze::babyai {

Instruction single(const Clause& a) { return {.clause = {a}, .first_part = 1}; }

Instruction both(const Clause& a, const Clause& b) { return {.clause = {a, b}, .first_part = 2}; }

Instruction ordered(const Instruction& a, Order order, const Instruction& b) {
  require(order != Order::any && a.order == Order::any && b.order == Order::any,
          "ordered instruction: expected two parts without an order of their own");
  Instruction joined = a;
  std::copy_n(b.clause.begin(), b.first_part, joined.clause.begin() + a.first_part);
  joined.second_part = b.first_part;
  joined.order = order;
  return joined;
}

}  // namespace wordgaze::babyai
