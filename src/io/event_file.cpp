#include "wordgaze/io/event_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>

#include "wordgaze/core/crc32.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

// --- the wire format of protocol buffers: a key (number of the field, how it is coded), then the
// value
enum class Coding : std::uint8_t { varint = 0, eight_bytes = 1, length = 2, four_bytes = 5 };

void put_varint(std::string& out, std::uint64_t number) {
  for (; number >= 128; number >>= 7) out += static_cast<char>((number & 127) | 128);
  out += static_cast<char>(number);
}
void put_key(std::string& out, unsigned field, Coding coding) {
  put_varint(out, field << 3 | static_cast<unsigned>(coding));
}
template <class Unsigned>
void put_bytes(std::string& out, Unsigned number) {  // the lowest first
  for (std::size_t i = 0; i < sizeof(number); ++i) out += static_cast<char>(number >> 8 * i);
}
void put_text(std::string& out, unsigned field, std::string_view text) {
  put_key(out, field, Coding::length);
  put_varint(out, text.size());
  out += text;
}

// Fields of tensorflow.Event (event.proto) and of what it holds.
constexpr unsigned kWallTime = 1, kStep = 2, kFileVersion = 3, kSummary = 5, kSessionLog = 7;
constexpr unsigned kSummaryValue = 1, kTag = 1, kSimpleValue = 2, kStatus = 1;

/// Of a length or of data, as TFRecord wants it.
std::uint32_t masked_checksum(std::string_view bytes) {
  return std::rotr(crc32c(bytes), 15) + 0xA282EAD8u;
}

double now() {
  const auto time = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

std::string cause_of(int error) { return std::generic_category().message(error); }

}  // namespace

EventFile::EventFile(const fs::path& folder, std::optional<std::int64_t> goes_on_at) {
  fs::create_directories(folder);
  const auto seconds = static_cast<std::int64_t>(now());
  for (int number = 0; file_ == nullptr; ++number) {
    // By this name TensorBoard finds it; files of one run are read in the order of their names.
    path_ =
        folder / fmt::format("events.out.tfevents.{:010}.{:03}.{}", seconds, number, ::getpid());
    file_.reset(std::fopen(path_.c_str(), "wbxe"));
    if (file_ == nullptr && errno != EEXIST) {
      throw std::runtime_error(
          fmt::format("cannot write '{}': {}", path_.string(), cause_of(errno)));
    }
  }
  std::string version;
  put_text(version, kFileVersion, "brain.Event:2");
  write(0, version);
  if (goes_on_at) {
    std::string log, event;
    put_key(log, kStatus, Coding::varint);
    put_varint(log, 1);  // START
    put_text(event, kSessionLog, log);
    write(*goes_on_at, event);
  }
}

void EventFile::add(std::int64_t step, std::string_view tag, double value) {
  std::string number, summary, event;
  put_text(number, kTag, tag);
  put_key(number, kSimpleValue, Coding::four_bytes);
  put_bytes(number, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  put_text(summary, kSummaryValue, number);
  put_text(event, kSummary, summary);
  write(step, event);
}

void EventFile::write(std::int64_t step, std::string_view rest_of_event) {
  if (!problem_.empty()) return;
  std::string event;
  put_key(event, kWallTime, Coding::eight_bytes);
  put_bytes(event, std::bit_cast<std::uint64_t>(now()));
  put_key(event, kStep, Coding::varint);
  put_varint(event, static_cast<std::uint64_t>(step));
  event += rest_of_event;

  std::string record;
  put_bytes(record, std::uint64_t{event.size()});
  put_bytes(record, masked_checksum(std::string(record)));
  record += event;
  put_bytes(record, masked_checksum(event));
  if (std::fwrite(record.data(), 1, record.size(), file_.get()) == record.size() &&
      std::fflush(file_.get()) == 0) {
    return;
  }
  problem_ =
      fmt::format("cannot write '{}': {}; going on without it", path_.string(), cause_of(errno));
}

}  // namespace wordgaze::io
