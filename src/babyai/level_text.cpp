#include "wordgaze/babyai/level_text.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "own_id.hpp"
#include "wordgaze/babyai/generator.hpp"
#include "wordgaze/babyai/generators.hpp"
#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/babyai/task.hpp"
#include "wordgaze/core/number.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/core/rng.hpp"

namespace wordgaze::babyai {
namespace {

using grid::Color;
using grid::DoorState;
using grid::Type;
using Thing = Plan::Thing;

/// The lines of a text without the empty ones around it and without what one cannot see at their
/// ends.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    begin = end + 1;
  }
  const auto blank = [](std::string_view line) {
    return line.find_first_not_of(" \t") == line.npos;
  };
  while (!lines.empty() && blank(lines.back())) lines.pop_back();
  const auto first = std::ranges::find_if_not(lines, blank);
  lines.erase(lines.begin(), first);
  return lines;
}

/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; (begin = line.find_first_not_of(" \t", begin)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

template <class E, std::size_t n>
std::optional<E> named(std::string_view word, const std::array<std::string_view, n>& names) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end()) return std::nullopt;
  return static_cast<E>(found - names.begin());
}

class Reader {
 public:
  explicit Reader(const LevelText& text) : text_(text) {}

  LevelSpec read() {
    LevelSpec level{
        .id = text_.id,
        .generate = generators::planned,
        .room_size = text_.room_size,
        .rows = text_.rows,
        .columns = text_.columns,
        .max_steps = text_.max_steps,
        .done_mode = text_.done == Done::declared ? DoneMode::sequential : DoneMode::off,
        .see_through_walls = text_.see_through_walls};
    check_own_id(text_.id);
    plan_.distinct = text_.distinct;
    read_map();
    for (const auto line : lines_of(text_.objects)) read_objects(line);
    for (const auto line : lines_of(text_.missions)) read_mission(line);
    if (text_.distinct) check_distinct();
    if (plan_.is_map()) {
      level.room_size = std::max({plan_.width, plan_.height, 3});
      level.rows = level.columns = 1;
      check_space();
    }
    if (plan_.missions.empty()) {
      level.rule = Rule::goal;
      expect(has(Type::goal), "missions",
             "there are none, and no goal to reach; expected missions, or 'goal' among the "
             "objects or in the map");
      expect(text_.done == Done::when_true, "done",
             "declared; expected missions whose clauses are declared");
      const int cells = plan_.is_map()
                            ? plan_.width * plan_.height
                            : level.room_size * level.room_size * level.rows * level.columns;
      if (level.max_steps == 0) level.max_steps = 4 * cells;
    }
    level.parameters = std::move(plan_);
    return level;
  }

 private:
  [[noreturn]] void fail(std::string_view where, const std::string& what) const {
    throw std::invalid_argument(formatted("level '{}': {}: {}", shortened(text_.id), where, what));
  }
  void expect(bool ok, std::string_view where, const char* what) const {
    if (!ok) fail(where, what);
  }

  /// "[locked|closed|open] [color] type", in the plural where there are several.
  Thing thing(std::span<const std::string_view> words, bool plural, std::string_view where,
              std::string_view line) const {
    Thing thing;
    std::size_t k = 0;
    bool has_state = false;
    if (k < words.size()) {
      if (const auto state = named<DoorState>(words[k], kStates)) {
        thing.state = *state;
        has_state = true;
        ++k;
      }
    }
    if (k < words.size()) {
      thing.color = named<Color>(words[k], grid::kColorNames);
      k += thing.color.has_value();
    }
    const std::string_view last = k < words.size() ? words[k] : "";
    std::string type(last);
    if (plural && type.ends_with("es") && type.starts_with("box")) type.resize(type.size() - 2);
    if (plural && type.ends_with('s')) type.pop_back();
    if (type != "object") thing.type = named<Type>(type, grid::kTypeNames);
    const bool known =
        type == "object" || (thing.type && *thing.type != Type::unseen &&
                             *thing.type != Type::empty && *thing.type != Type::agent);
    if (!known || k + 1 != words.size()) {
      fail(where,
           formatted("'{}'; expected as 'blue key', 'locked red door', '2 balls': a color, if "
                     "it is not to be drawn (red, green, blue, purple, yellow, grey), and "
                     "key, ball, box, object, door, goal, lava, floor or wall",
                     shortened(line)));
    }
    if (has_state && thing.type != Type::door) {
      fail(where, formatted("'{}'; open, closed and locked are doors alone", shortened(line)));
    }
    const bool colorless =
        thing.type == Type::wall || thing.type == Type::goal || thing.type == Type::lava;
    if (colorless && thing.color) {
      fail(where, formatted("'{}'; goals, lava and walls have one color", shortened(line)));
    }
    return thing;
  }

  std::map<char, Thing> read_legend() const {
    std::map<char, Thing> legend{{'#', {.type = Type::wall}}, {'D', {.type = Type::door}},
                                 {'K', {.type = Type::key}},  {'B', {.type = Type::ball}},
                                 {'X', {.type = Type::box}},  {'G', {.type = Type::goal}},
                                 {'L', {.type = Type::lava}}};
    for (const auto line : lines_of(text_.legend)) {
      const auto words = words_of(line);
      const bool form = words.size() >= 3 && words[0].size() == 1 && words[1] == "=";
      const char letter = form ? words[0][0] : ' ';
      if (!form || letter <= ' ' || letter > '~' || kReserved.find(letter) != kReserved.npos) {
        fail("legend", formatted("'{}'; expected as 'k = yellow key': a letter other than {}",
                                 shortened(line), kReserved));
      }
      legend[letter] = thing(std::span(words).subspan(2), false, "legend", line);
    }
    return legend;
  }

  void read_map() {
    const auto rows = lines_of(text_.map);
    if (rows.empty()) {
      expect(text_.legend.empty(), "legend", "there is no map whose letters it could explain");
      return;
    }
    const auto legend = read_legend();
    expect(rows.size() <= std::size_t{kMaxGridSide}, "map", "it has more than 1024 rows");
    expect(rows[0].size() <= std::size_t{kMaxGridSide}, "map", "it has more than 1024 columns");
    plan_.height = static_cast<int>(rows.size());
    plan_.width = static_cast<int>(rows[0].size());
    expect(plan_.width * plan_.height > 1, "map", "it has one cell; expected more");
    for (int y = 0; y < plan_.height; ++y) {
      const std::string_view row = rows[static_cast<std::size_t>(y)];
      if (row.size() != rows[0].size()) {
        fail("map", formatted("row {} has {} letters, the first one {}; expected as many", y + 1,
                              row.size(), rows[0].size()));
      }
      for (int x = 0; x < plan_.width; ++x) {
        read_cell(row[static_cast<std::size_t>(x)], grid::at(x, y), legend);
      }
    }
  }

  void read_cell(char letter, grid::Position place, const std::map<char, Thing>& legend) {
    if (letter == '.' || letter == ' ') return;
    constexpr std::string_view kLooks = ">v<^";  // as Direction
    const std::size_t looks = kLooks.find(letter);
    if (letter == 'A' || looks != kLooks.npos) {
      if (plan_.agent) fail("map", "it has two agents; expected one, or none for anywhere");
      plan_.agent = place;
      if (looks != kLooks.npos) plan_.direction = static_cast<grid::Direction>(looks);
      return;
    }
    const auto found = legend.find(letter);
    if (found == legend.end()) {
      const bool shown = letter > ' ' && letter <= '~';
      fail("map", formatted("row {}, column {}: the letter {}; expected one of .#A>v<^DKBXGL or of "
                            "the legend",
                            place.y + 1, place.x + 1,
                            shown ? formatted("'{}'", letter)
                                  : formatted("of code {}", static_cast<unsigned char>(letter))));
    }
    plan_.cells.push_back({place, found->second});
  }

  void read_objects(std::string_view line) {
    const auto words = words_of(line);
    if (words.empty()) return;
    const auto count = number_in<int>(words[0]);
    const auto rest = std::span(words).subspan(count ? 1 : 0);
    const Thing placed = thing(rest, count.has_value() && *count != 1, "objects", line);
    if (count && (*count < 0 || *count > grid::kMaxObjects)) {
      fail("objects", formatted("'{}'; expected 0 to {}", shortened(line), grid::kMaxObjects));
    }
    const bool fixed = placed.type == Type::door || placed.type == Type::wall ||
                       placed.type == Type::floor || placed.type == Type::lava;
    if (fixed) {
      fail("objects", formatted("'{}'; keys, balls, boxes and goals are placed at random, doors, "
                                "walls, floor and lava stand in a map",
                                shortened(line)));
    }
    plan_.objects.insert(plan_.objects.end(), static_cast<std::size_t>(count.value_or(1)), placed);
  }

  /// A mission; "{}" is read as "the object", and remembered as a gap.
  void read_mission(std::string_view line) {
    constexpr std::string_view kGap = "{}", kFilled = "the object";
    const auto words = words_of(line);
    if (words.empty()) return;
    std::string filled;
    std::vector<bool> gaps;  // a flag a description, in their order
    for (std::size_t k = 0; k < words.size(); ++k) {
      const bool comma = words[k].ends_with(',');
      const auto word = words[k].substr(0, words[k].size() - comma);
      if (k > 0) filled += ' ';
      if (word == kGap || word == "the" || word == "a") gaps.push_back(word == kGap);
      filled += word == kGap ? kFilled : word;
      if (comma) filled += ',';
    }
    Plan::Mission mission{.text = std::string(line)};
    try {
      mission.instruction = parse_mission(filled);
    } catch (const std::invalid_argument& error) {
      fail("missions", error.what());
    }
    std::size_t description = 0;
    for (int k = 0; k < mission.instruction.clauses(); ++k) {
      const Clause& clause = mission.instruction.clause[k];
      for (const bool next_to : {false, true}) {
        if (next_to && clause.verb != Verb::put_next) continue;
        if (gaps[description++]) {
          mission.gaps.push_back({.clause = k, .next_to = next_to});
        } else {
          check_there(line, clause, next_to);
        }
      }
    }
    check_gaps(line, mission);
    plan_.missions.push_back(std::move(mission));
  }

  /// Calls f(thing) for all that is placed.
  template <class F>
  void for_each_thing(F&& f) const {
    for (const Plan::Cell& cell : plan_.cells) f(cell.thing);
    for (const Thing& thing : plan_.objects) f(thing);
  }
  static bool can_be_carried(const Thing& thing) {
    const Type type = thing.type.value_or(Type::key);
    return type >= Type::key && type <= Type::box;
  }
  bool has_rooms() const { return !plan_.is_map() && text_.columns * text_.rows > 1; }

  /// Whether there are as many things as a mission has gaps.
  void check_gaps(std::string_view line, const Plan::Mission& mission) const {
    const auto asks = [&](bool doors, bool carried) {
      std::size_t count = 0;
      for (const auto& gap : mission.gaps) {
        const Verb verb = mission.instruction.clause[static_cast<std::size_t>(gap.clause)].verb;
        const bool wants_door = verb == Verb::open, any = verb == Verb::go_to;
        count += any ? doors && carried : wants_door ? doors : carried;
      }
      return count;
    };
    std::size_t doors = has_rooms(), carried = 0;
    for_each_thing([&](const Thing& thing) {
      doors += thing.type == Type::door;
      carried += can_be_carried(thing);
    });
    const bool enough =
        (has_rooms() || (asks(true, false) <= doors && asks(true, true) <= doors + carried)) &&
        asks(false, true) <= carried;
    if (enough) return;
    fail("missions", formatted("'{}' has more gaps than there are things to fill them: {} that can "
                               "be carried, {} doors",
                               shortened(line), carried, doors));
  }

  /// Whether what is drawn can be unlike all others: there are six colors of three types.
  void check_distinct() const {
    constexpr int kColors = 6;
    std::array<std::array<bool, kColors>, 3> given{};
    std::array<int, 3> drawn{};
    int any = 0;
    for_each_thing([&](const Thing& thing) {
      if (!can_be_carried(thing)) return;
      if (!thing.type) {
        ++any;
        return;
      }
      const auto type = static_cast<std::size_t>(*thing.type) - static_cast<std::size_t>(Type::key);
      if (thing.color) {
        given[type][static_cast<std::size_t>(*thing.color)] = true;
      } else {
        ++drawn[type];
      }
    });
    int total = any;
    bool fits = true;
    for (std::size_t type = 0; type < given.size(); ++type) {
      const int of_type = drawn[type] + static_cast<int>(std::ranges::count(given[type], true));
      fits = fits && (drawn[type] == 0 || of_type <= kColors);
      total += of_type;
    }
    if (fits && (any == 0 || total <= 3 * kColors)) return;
    fail(
        "objects",
        "more of one type than there are colors, so that some must be alike; say distinct = false");
  }

  /// Whether something may be what a fixed description means.
  void check_there(std::string_view line, const Clause& clause, bool next_to) const {
    const Description& d = next_to ? clause.next_to : clause.object;
    const auto may_be = [&](const Thing& thing) {
      const bool type = !d.type || !thing.type || *d.type == *thing.type;
      return type && (!d.color || !thing.color || *d.color == *thing.color);
    };
    bool there = has_rooms() && may_be({.type = Type::door});
    for_each_thing([&](const Thing& thing) { there = there || may_be(thing); });
    if (there) return;
    std::string name = d.color ? std::string(grid::name(*d.color)) + " " : "";
    name += d.type ? grid::name(*d.type) : "object";
    fail("missions",
         formatted("'{}': nothing in the level can be a {}; place one", shortened(line), name));
  }

  bool has(Type type) const {
    bool found = false;
    for_each_thing([&](const Thing& thing) { found = found || thing.type == type; });
    return found;
  }

  void check_space() const {
    const std::size_t cells =
        static_cast<std::size_t>(plan_.width) * static_cast<std::size_t>(plan_.height);
    const std::size_t taken = plan_.cells.size() + plan_.objects.size() + 1;
    if (taken > cells) {
      fail("objects", formatted("the map has {} empty cells; {} objects and the agent need more",
                                cells - plan_.cells.size(), plan_.objects.size()));
    }
  }

  static constexpr std::string_view kReserved = ".A>v<^";
  static constexpr std::array<std::string_view, 3> kStates{"open", "closed", "locked"};

  const LevelText& text_;
  Plan plan_;
};

}  // namespace

LevelSpec level_of(const LevelText& text) {
  LevelSpec level = Reader(text).read();
  validate(level);
  // What can never be drawn is said here, not at the first episode.
  core::Rng rng(1);
  grid::World world;
  Task task;
  require(
      generate(level, rng, world, task),
      "level '{}': no world of it can be drawn: what its missions ask for is hardly ever there, "
      "or its objects leave no way",
      level.id);
  return level;
}

bool has_more(const LevelSpec& level) {
  const auto* plan = std::get_if<Plan>(&level.parameters);
  if (plan == nullptr) return false;
  const auto more = [](const Thing& thing) {
    const Type type = thing.type.value_or(Type::key);
    return type != Type::wall && (type < Type::key || type > Type::box);
  };
  return std::ranges::any_of(plan->objects, more) ||
         std::ranges::any_of(plan->cells, more, &Plan::Cell::thing);
}

}  // namespace wordgaze::babyai
