#include "wordgaze/evaluation/pointing.hpp"

#include <algorithm>

#include "words.hpp"

namespace wordgaze::evaluation {

std::size_t brightest(std::span<const float> map) {
  return static_cast<std::size_t>(std::max_element(map.begin(), map.end()) - map.begin());
}

void Pointing::add(std::span<const float> map, const Roles& roles) {
  const Role pointed = roles[brightest(map)];
  const auto objects =
      std::count_if(roles.begin(), roles.end(), [](Role role) { return is_object(role); });
  // Roles are ordered: targets are named too.
  const auto play = [&](Role least, Mean& hit, Mean& chance) {
    const auto in_view =
        std::count_if(roles.begin(), roles.end(), [&](Role role) { return role <= least; });
    if (in_view == 0) return;
    hit.add(pointed <= least);
    chance.add(static_cast<double>(in_view) / static_cast<double>(objects));
  };
  play(Role::target, target, target_chance);
  play(Role::named, named, named_chance);
}

void Pointing::add(const policy::Policy& policy, int lane,
                   std::span<const std::uint8_t, grid::kImageBytes> image,
                   const babyai::Progress& progress) {
  std::array<float, grid::kViewCells> map;
  if (policy.gaze(lane, map)) add(map, roles_of(image, progress));
}

void WordPointing::add(std::span<const float> maps, const babyai::Sentence& sentence,
                       std::span<const std::uint8_t, grid::kImageBytes> image) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(sentence.length); ++i) {
    const auto wanted_color = color_of(sentence.words[i]);
    const auto wanted_type = type_of(sentence.words[i]);
    if (!wanted_color && !wanted_type) continue;
    const auto fits = [&](std::size_t cell) {
      const auto seen_type = static_cast<grid::Type>(image[3 * cell]);
      const auto seen_color = static_cast<grid::Color>(image[3 * cell + 1]);
      return is_object(seen_type) && seen_type == wanted_type.value_or(seen_type) &&
             seen_color == wanted_color.value_or(seen_color);
    };
    bool in_view = false;
    for (std::size_t cell = 0; cell < grid::kViewCells; ++cell) in_view |= fits(cell);
    if (!in_view) continue;
    const auto map = maps.subspan(i * grid::kViewCells, grid::kViewCells);
    (wanted_color ? color : type).add(fits(brightest(map)));
  }
}

}  // namespace wordgaze::evaluation
