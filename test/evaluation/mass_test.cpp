#include "wordgaze/evaluation/mass.hpp"

#include <gtest/gtest.h>

namespace wordgaze::evaluation {
namespace {

double share(const Mass& mass, Role role) {
  return mass.share[static_cast<std::size_t>(role)].value();
}

TEST(Mass, IsSharedOutToTheRoles) {
  Roles roles;
  roles.fill(Role::empty);
  roles[0] = Role::target;
  roles[1] = roles[2] = Role::wall;
  std::array<float, grid::kViewCells> map{};
  map[0] = 3;
  map[1] = map[2] = 0.5;
  Mass mass;
  mass.add(map, roles);
  EXPECT_DOUBLE_EQ(share(mass, Role::target), 0.75);
  EXPECT_DOUBLE_EQ(share(mass, Role::wall), 0.25);
  EXPECT_DOUBLE_EQ(share(mass, Role::empty), 0);
  EXPECT_NEAR(mass.even[static_cast<std::size_t>(Role::wall)].value(), 2.0 / 49, 1e-12);
}

TEST(Mass, OfEachMapIsOne) {
  Roles roles;
  for (std::size_t c = 0; c < roles.size(); ++c) roles[c] = static_cast<Role>(c % kRoles);
  std::array<float, grid::kViewCells> map;
  for (std::size_t c = 0; c < map.size(); ++c) map[c] = static_cast<float>(c);
  Mass mass;
  mass.add(map, roles);
  mass.add(std::array<float, grid::kViewCells>{}, roles);  // all zero: left out
  double total = 0;
  for (const Mean& mean : mass.share) total += mean.value();
  EXPECT_NEAR(total, 1, 1e-12);
}

TEST(Mass, OfNowhereIsPartOfTheWhole) {
  Roles roles;
  roles.fill(Role::empty);
  roles[0] = Role::target;
  std::array<float, grid::kViewCells> map{};
  map[0] = 0.25f;
  Mass mass;
  mass.add(map, roles, 0.75);
  EXPECT_DOUBLE_EQ(share(mass, Role::target), 0.25);
  EXPECT_DOUBLE_EQ(mass.nowhere.value(), 0.75);
}

TEST(Glow, IsOfTheBrightestObject) {
  Roles roles;
  roles.fill(Role::wall);
  std::array<float, grid::kViewCells> map{};
  map[9] = 0.9f;  // a wall
  Glow glow;
  glow.add(map, roles);
  EXPECT_EQ(glow.brightest.count, 0);
  roles[3] = roles[4] = Role::distractor;
  map[3] = 0.125f;
  map[4] = 0.25f;
  glow.add(map, roles);
  map[4] = 0.75f;
  glow.add(map, roles);
  EXPECT_DOUBLE_EQ(glow.brightest.value(), 0.5);
  EXPECT_DOUBLE_EQ(glow.over_half.value(), 0.5);
}

}  // namespace
}  // namespace wordgaze::evaluation
