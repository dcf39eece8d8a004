#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::evaluation {

using grid::Type;

Role role_of(Type type, grid::Color color, const babyai::Progress& progress) {
  if (type == Type::unseen) return Role::unseen;
  if (type == Type::empty || type == Type::floor) return Role::empty;
  if (type == Type::wall) return Role::wall;
  if (!is_object(type)) return Role::other;
  Role role = Role::distractor;
  const auto turn = progress.enabled();
  for (std::size_t i = 0; i < turn.size(); ++i) {
    if (!babyai::fits(progress.object(i), type, color)) continue;
    role = std::min(role, turn[i] ? Role::target : Role::named);
  }
  return role;
}

Roles roles_of(std::span<const std::uint8_t, grid::kImageBytes> image,
               const babyai::Progress& progress) {
  Roles roles;
  for (std::size_t c = 0; c < roles.size(); ++c) {
    roles[c] = role_of(static_cast<Type>(image[3 * c]), static_cast<grid::Color>(image[3 * c + 1]),
                       progress);
  }
  return roles;
}

}  // namespace wordgaze::evaluation
