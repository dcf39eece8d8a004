#include "wordgaze/evaluation/faithfulness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace wordgaze::evaluation {
namespace {

using Cells = std::vector<std::size_t>;

/// All cells, the brightest first; of equally bright ones the first.
Cells by_brightness(std::span<const float> map) {
  Cells cells(map.size());
  std::iota(cells.begin(), cells.end(), 0);
  std::stable_sort(cells.begin(), cells.end(),
                   [&](std::size_t a, std::size_t b) { return map[a] > map[b]; });
  return cells;
}

/// The cells of a change; empty when there are too few.
Cells choose(const Change& change, const Cells& ordered, const Roles& roles, core::Rng& rng) {
  const auto count = static_cast<std::size_t>(change.count);
  Cells cells;
  if (change.cells == Change::Cells::brightest) {
    cells.assign(ordered.begin(), ordered.begin() + change.count);
    return cells;
  }
  std::copy_if(ordered.begin() + change.count, ordered.end(), std::back_inserter(cells),
               [&](std::size_t cell) {
                 return change.cells == Change::Cells::objects ? is_object(roles[cell])
                                                               : roles[cell] != Role::unseen;
               });
  if (cells.size() < count) return {};
  rng.shuffle(std::span<std::size_t>(cells));
  cells.resize(count);
  return cells;
}

}  // namespace

Shifts shifts(const DecisionContext& context, std::span<const float> map, const Roles& roles,
              core::Rng& rng) {
  policy::Policy& policy = context.policy;
  const auto seen = policy.frames().cells.col(context.lane);
  const auto blank = static_cast<std::uint8_t>(policy.design().alphabet.find({0, 0, 0}));
  const Cells ordered = by_brightness(map);
  // The last view is the one that was seen; that of an impossible change stays the same, too.
  model::CellMatrix views = seen.replicate(1, static_cast<Index>(kChanges.size()) + 1);
  std::array<bool, kChanges.size()> possible{};
  for (std::size_t i = 0; i < kChanges.size(); ++i) {
    const Cells cells = choose(kChanges[i], ordered, roles, rng);
    possible[i] = !cells.empty();
    if (!possible[i]) continue;
    auto view = views.col(static_cast<Index>(i));
    const bool deletion = kChanges[i].test == Change::Test::deletion;
    if (!deletion) view.setConstant(blank);
    for (const std::size_t cell : cells) {
      const auto c = static_cast<Index>(cell);
      view(c) = deletion ? blank : seen(c);
    }
  }
  const Matrix<float> policies = policy.policies_for(context.lane, views);
  const auto before = policies.rightCols(1).array();
  Shifts shifts;
  for (std::size_t i = 0; i < kChanges.size(); ++i) {
    const auto after = policies.col(static_cast<Index>(i)).array();
    shifts[i] = possible[i] ? 0.5 * static_cast<double>((after - before).abs().sum())
                            : std::numeric_limits<double>::quiet_NaN();
  }
  return shifts;
}

void Faithfulness::add(const Shifts& shifts) {
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (!std::isnan(shifts[i])) shift[i].add(shifts[i]);
  }
}

const Mean& Faithfulness::of(Change::Test test, Change::Cells cells, int count) const {
  const auto found = std::find_if(kChanges.begin(), kChanges.end(), [&](const Change& c) {
    return c.test == test && c.cells == cells && c.count == count;
  });
  require(found != kChanges.end(), "Faithfulness: {} cells are not measured", count);
  return shift[static_cast<std::size_t>(found - kChanges.begin())];
}

}  // namespace wordgaze::evaluation
