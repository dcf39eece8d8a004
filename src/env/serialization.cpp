#include <bit>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::env {
namespace {

static_assert(std::endian::native == std::endian::little, "serialized states are little-endian");

// Behind the mark: a checksum of the rest, the id, the state.
constexpr std::uint64_t kMark = 0x33656d6167647277;  // "wrdgame3"

std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t h = 0xCBF29CE484222325;  // FNV-1a
  for (std::uint8_t byte : bytes) h = (h ^ byte) * 0x100000001B3;
  return h;
}

// Writer and Reader walk the same lists of members; a container is its size and its elements.
template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

class Writer {
 public:
  template <class... Members>
  void operator()(const Members&... members) {
    (write(members), ...);
  }
  std::vector<std::uint8_t> bytes;

 private:
  void append(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
  }
  template <Plain T>
  void write(const T& value) {
    append(&value, sizeof value);
  }
  template <class Container>
  requires(!Plain<Container>) void write(const Container& items) {
    write(items.size());
    append(items.data(), items.size() * sizeof *items.data());
  }
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <class... Members>
  void operator()(Members&... members) {
    (read(members), ...);
  }
  std::span<const std::uint8_t> rest() const { return rest_; }

 private:
  void take(void* data, std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("restore: the state is cut off");
    std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  template <Plain T>
  void read(T& value) {
    take(&value, sizeof value);
  }
  template <class Container>
  requires(!Plain<Container>) void read(Container& items) {
    std::size_t size = 0;
    read(size);
    if (size > rest_.size()) throw std::runtime_error("restore: the state is cut off");
    items.resize(size);
    take(items.data(), size * sizeof *items.data());
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace

template <class Archive, class Env>
void Environment::archive(Archive& archive, Env& env) {
  auto& w = env.world_;
  archive(env.rng_, env.seeded_, env.task_, w.objects, w.looks, w.see_through_walls, w.agent,
          w.direction, w.carried, w.carried_from, w.step_count, w.room_size);
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
  Reader reader(bytes);
  std::uint64_t mark = 0, sum = 0;
  reader(mark, sum);
  if (mark != kMark || sum != checksum(reader.rest())) {
    throw std::runtime_error("restore: these bytes are not the state of an environment");
  }
  std::string id;
  babyai::DoneMode done_mode{};
  reader(id, done_mode);
  if (id != spec_->id || done_mode != spec_->done_mode) {
    throw std::runtime_error(formatted("restore: the state belongs to '{}', this is '{}'{}", id,
                                       spec_->id, id == spec_->id ? " in another done mode" : ""));
  }
  Environment restored = *this;
  archive(reader, restored);
  *this = std::move(restored);
}

}  // namespace wordgaze::env
