#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "soundness.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {
namespace {

static_assert(std::endian::native == std::endian::little, "serialized states are little-endian");

// Behind the mark: a checksum of the rest, the id, the state.
constexpr std::uint64_t kMark = 0x34656d6167647277;  // "wrdgame4"
// The same with what the compiler leaves between members, and with the looks of the objects.
constexpr std::uint64_t kFormerMark = 0x33656d6167647277;  // "wrdgame3"

std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t h = 0xCBF29CE484222325;  // FNV-1a
  for (std::uint8_t byte : bytes) h = (h ^ byte) * 0x100000001B3;
  return h;
}

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("restore: " + what); }

// The last value of an enum.
template <class E>
constexpr E kLast = E{};
template <>
constexpr auto kLast<grid::Type> = grid::Type::agent;
template <>
constexpr auto kLast<grid::Color> = grid::Color::grey;
template <>
constexpr auto kLast<grid::DoorState> = grid::DoorState::locked;
template <>
constexpr auto kLast<grid::Direction> = grid::Direction::up;
template <>
constexpr auto kLast<babyai::Verb> = babyai::Verb::put_next;
template <>
constexpr auto kLast<babyai::Location> = babyai::Location::behind;
template <>
constexpr auto kLast<babyai::Order> = babyai::Order::after;
template <>
constexpr auto kLast<babyai::DoneMode> = babyai::DoneMode::sequential;

// Writer and Reader walk the same lists of members, each by itself: what lies between them in
// memory is no part of a state. gap(n) is where the former layout has n such bytes.
template <class T, class U>
concept Some = std::same_as<std::remove_const_t<T>, U>;

void walk(auto& archive, Some<grid::Position> auto& p) { archive(p.x, p.y); }
void walk(auto& archive, Some<grid::Object> auto& o) {
  archive(o.type, o.color, o.state, o.contents, o.position);
}
void walk(auto& archive, Some<core::Rng::State> auto& s) {
  archive(s.state_low, s.state_high, s.increment_low, s.increment_high, s.half, s.has_half);
  archive.gap(11);
}
void walk(auto& archive, Some<babyai::Description> auto& d) {
  archive(d.type, d.color, d.location);
}
void walk(auto& archive, Some<babyai::Clause> auto& c) {
  archive(c.verb, c.object, c.next_to, c.strict);
}
void walk(auto& archive, Some<babyai::Instruction> auto& i) {
  archive(i.clause, i.order, i.count, i.strict);
}
void walk(auto& archive, Some<babyai::Meaning> auto& m) {
  archive(m.object, m.next_to, m.agent, m.direction);
  archive.gap(3);
}
void walk(auto& archive, Some<babyai::Sentence> auto& s) {
  archive(s.words, s.sub_task_of);
  archive.gap(2);
  archive(s.length);
}
void walk(auto& archive, Some<babyai::Target> auto& t) {
  archive(t.object, t.other, t.place, t.trap);
}
void walk(auto& archive, Some<babyai::Task> auto& t) {
  archive(t.instruction);
  archive.gap(6);
  archive(t.meaning, t.sentence, t.target);
  archive.gap(2);
  archive(t.max_steps, t.start_carrying);
  archive.gap(7);
}

template <class T>
concept Number = std::is_arithmetic_v<T>;
template <class T>
concept Enum = std::is_enum_v<T>;
template <class T>
concept List = requires(T& list) {
  list.resize(list.size());
};

class Writer {
 public:
  template <class... Members>
  void operator()(const Members&... members) {
    (write(members), ...);
  }
  void gap(std::size_t) {}
  void looks(const grid::World&) {}

  std::vector<std::uint8_t> bytes;

 private:
  template <class T>
  requires(Number<T> || Enum<T>) void write(const T& value) {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
  }
  void write(const core::Rng& rng) {
    const core::Rng::State state = rng.state();
    walk(*this, state);
  }
  template <Enum E>
  void write(const std::optional<E>& value) {
    write(value.value_or(E{}));
    write(value.has_value());
  }
  template <class T, std::size_t n>
  void write(const std::array<T, n>& items) {
    for (const T& item : items) write(item);
  }
  template <List L>
  void write(const L& items) {
    write(std::uint64_t{items.size()});
    for (const auto& item : items) write(item);
  }
  template <class T>
  void write(const T& value) {
    walk(*this, value);
  }
};

// Believes nothing: a value that its type does not have is refused when it is read.
class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, bool former) : rest_(bytes), former_(former) {}

  template <class... Members>
  void operator()(Members&... members) {
    (read(members), ...);
  }
  void gap(std::size_t size) {
    if (former_) take(size);
  }
  void looks(const grid::World& world) {
    if (!former_) return;
    const auto looks = take(world.looks.size());
    for (std::size_t id = 0; id < std::min(world.objects.size(), looks.size()); ++id) {
      if (looks[id] != look_of(world.objects[id])) fail("the look of an object is not its own");
    }
  }
  void expect_end() const {
    if (!rest_.empty()) fail("bytes behind the end of the state");
  }

 private:
  std::span<const std::uint8_t> take(std::size_t size) {
    if (size > rest_.size()) fail("the state is cut off");
    const auto taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  template <Number T>
  void read(T& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void read(bool& value) {
    const std::uint8_t byte = take(1)[0];
    if (byte > 1) fail("a truth value is neither 0 nor 1");
    value = byte == 1;
  }
  template <Enum E>
  void read(E& value) {
    value = checked<E>(take(1)[0]);
  }
  template <Enum E>
  static E checked(std::uint8_t byte) {
    static_assert(sizeof(E) == 1);
    if (byte > static_cast<std::uint8_t>(kLast<E>)) fail("a kind that there is not");
    return static_cast<E>(byte);
  }
  void read(core::Rng& rng) {
    core::Rng::State state;
    walk(*this, state);
    if (state.increment_low % 2 == 0) fail("the random stream has an even increment");
    rng = core::Rng(state);
  }
  template <Enum E>
  void read(std::optional<E>& value) {
    const std::uint8_t byte = take(1)[0];
    bool has_value = false;
    read(has_value);
    value = has_value ? std::optional(checked<E>(byte)) : std::nullopt;
  }
  template <class T, std::size_t n>
  void read(std::array<T, n>& items) {
    for (T& item : items) read(item);
  }
  template <List L>
  void read(L& items) {
    std::uint64_t size = 0;
    read(size);
    if (size > rest_.size()) fail("the state is cut off");
    items.resize(size);
    for (auto& item : items) read(item);
  }
  template <class T>
  void read(T& value) {
    walk(*this, value);
  }

  std::span<const std::uint8_t> rest_;
  bool former_;
};

}  // namespace

template <class Archive, class Env>
void Environment::archive(Archive& archive, Env& env) {
  auto& w = env.world_;
  archive(env.rng_, env.seeded_, env.task_, w.objects);
  archive.looks(w);
  archive(w.see_through_walls, w.agent, w.direction, w.carried, w.carried_from, w.step_count,
          w.room_size);
  w.grid.archive(archive);
  env.verifier_.archive(archive);
}

std::vector<std::uint8_t> Environment::serialize() const {
  Writer state;
  state(spec_->id, spec_->done_mode);
  archive(state, *this);
  Writer framed;
  framed(kMark, checksum(state.bytes));
  framed.bytes.insert(framed.bytes.end(), state.bytes.begin(), state.bytes.end());
  return std::move(framed.bytes);
}

void Environment::restore(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kFrame = 2 * sizeof(std::uint64_t);
  std::uint64_t mark = 0, sum = 0;
  if (bytes.size() >= kFrame) Reader(bytes, false)(mark, sum);
  if ((mark != kMark && mark != kFormerMark) || sum != checksum(bytes.subspan(kFrame))) {
    fail("these bytes are not the state of an environment");
  }
  Reader reader(bytes.subspan(kFrame), mark == kFormerMark);
  std::string id;
  babyai::DoneMode done_mode{};
  reader(id, done_mode);
  if (id != spec_->id || done_mode != spec_->done_mode) {
    fail(formatted("the state belongs to '{}', this is '{}'{}", id.substr(0, 100), spec_->id,
                   id == spec_->id ? " in another done mode" : ""));
  }
  Environment restored = *this;
  archive(reader, restored);
  reader.expect_end();
  if (restored.seeded_) {
    check_sound(*spec_, restored.world_, restored.task_);
    if (!restored.verifier_.is_sound(restored.world_, restored.task_.instruction,
                                     spec_->done_mode)) {
      fail("the state is damaged: what was done of the instruction");
    }
    grid::World& world = restored.world_;
    std::ranges::transform(world.objects, world.looks.begin(), grid::look_of);
  }
  // A state has one form; that of an environment before its first reset is always the same.
  const auto again = restored.serialize();
  const bool sound = restored.seeded_ ? mark == kFormerMark || std::ranges::equal(again, bytes)
                                      : again == Environment(*spec_).serialize();
  if (!sound) fail("the state is damaged: something in it is never used");
  *this = std::move(restored);
}

}  // namespace wordgaze::env
