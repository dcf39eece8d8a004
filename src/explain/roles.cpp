#include "wordgaze/explain/roles.hpp"

namespace wordgaze::explain {
namespace {

using grid::Type;

bool fits(const babyai::Description& description, Type type, grid::Color color) {
  return description.type.value_or(type) == type && description.color.value_or(color) == color;
}

Role role_of(Type type, grid::Color color, const babyai::Instruction& instruction,
             std::span<const std::uint8_t> turn) {
  if (type == Type::unseen) return Role::unseen;
  if (type == Type::empty || type == Type::floor) return Role::empty;
  if (type == Type::wall) return Role::wall;
  if (!is_object(type)) return Role::other;
  Role role = Role::distractor;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const auto& clause = instruction.clause[i];
    const bool meant = fits(clause.object, type, color) ||
                       (clause.verb == babyai::Verb::put_next && fits(clause.next_to, type, color));
    if (meant) role = std::min(role, turn[i] ? Role::target : Role::named);
  }
  return role;
}

}  // namespace

Roles roles_of(std::span<const std::uint8_t, grid::kImageBytes> image,
               const babyai::Instruction& instruction, std::span<const std::uint8_t> turn) {
  Roles roles;
  for (std::size_t c = 0; c < roles.size(); ++c) {
    roles[c] = role_of(static_cast<Type>(image[3 * c]), static_cast<grid::Color>(image[3 * c + 1]),
                       instruction, turn);
  }
  return roles;
}

}  // namespace wordgaze::explain
