#include <algorithm>
#include <span>

#include "wordgaze/babyai/generators.hpp"

namespace wordgaze::babyai::generators {
namespace {

Clause draw_clause(Layout& layout, grid::ObjectId target) {
  constexpr std::array kVerbs{Verb::go_to, Verb::pickup};
  return {.verb = layout.pick(kVerbs), .object = layout.describe(target)};
}

Instruction sequence(std::span<const Instruction> parts) {
  Instruction whole = parts[0];
  for (const Instruction& part : parts.subspan(1)) whole = ordered(whole, Order::before, part);
  return whole;
}

/// Parts of one or two clauses, one done after the other. Every second time there is an "after you"
/// between two of them.
Instruction chain(Layout& layout, std::span<const Clause> c) {
  std::array<Instruction, Instruction::kMaxClauses> drawn{};
  std::size_t count = 0;
  while (!c.empty()) {
    const bool two = c.size() > 1 && layout.rng.below(2) == 1;
    drawn[count++] = two ? both(c[0], c[1]) : single(c[0]);
    c = c.subspan(two ? 2 : 1);
  }
  const auto parts = std::span<const Instruction>(drawn).first(count);
  if (layout.rng.below(2) == 0) return sequence(parts);
  const auto after = static_cast<std::size_t>(1 + layout.rng.below(static_cast<int>(count) - 1));
  return ordered(sequence(parts.first(after)), Order::after, sequence(parts.subspan(after)));
}

/// Joins up to four clauses in one of their ways, each as likely. More than two have an order, for
/// "and" joins two; more than four are a chain.
Instruction join(Layout& layout, const std::array<Clause, Instruction::kMaxClauses>& c) {
  const int clauses = layout.parameters<OneRoomTask>().clauses;
  if (clauses > 4) return chain(layout, std::span(c).first(static_cast<std::size_t>(clauses)));
  if (clauses == 1) return single(c[0]);
  constexpr std::array kJoins{Order::any, Order::before, Order::after};
  const Order order =
      layout.pick(clauses == 2 ? std::span<const Order>(kJoins) : std::span(kJoins).subspan(1));
  if (order == Order::any) return both(c[0], c[1]);
  if (clauses == 2) return ordered(single(c[0]), order, single(c[1]));
  if (clauses == 4) return ordered(both(c[0], c[1]), order, both(c[2], c[3]));
  return layout.rng.below(2) == 0 ? ordered(both(c[0], c[1]), order, single(c[2]))
                                  : ordered(single(c[0]), order, both(c[1], c[2]));
}

}  // namespace

// Wordgaze-One to Wordgaze-Eight: as many of the objects in the room are targets.
void one_room_task(Layout& layout) {
  layout.place_agent();
  const OneRoomTask& wanted = layout.parameters<OneRoomTask>();
  const grid::ObjectRange objects = layout.scatter(std::nullopt, wanted.objects, true);
  layout.require_reachable();

  std::array<grid::ObjectId, grid::kMaxObjects> left{};
  for (int i = 0; i < objects.size(); ++i) left[static_cast<std::size_t>(i)] = objects[i];
  std::array<grid::ObjectId, Instruction::kMaxClauses> targets{};
  for (int i = 0; i < wanted.clauses; ++i) {
    auto* drawn = left.data() + layout.rng.below(objects.size() - i);
    targets[static_cast<std::size_t>(i)] = *drawn;
    std::copy(drawn + 1, left.data() + left.size(), drawn);
  }
  std::array<Clause, Instruction::kMaxClauses> c{};
  for (int i = 0; i < wanted.clauses; ++i) {
    const auto k = static_cast<std::size_t>(i);
    c[k] = draw_clause(layout, targets[k]);
  }
  layout.task.instruction = join(layout, c);
}

}  // namespace wordgaze::babyai::generators
