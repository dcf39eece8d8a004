// LCM logs to go on with: damaged ones are refused and stay as they are, of a torn one the tail is
// cut. Each event of the log that is left is followed by another or by the end.
#include "fuzz.hpp"
#include "lcm/event_log.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/lcm/log_writer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  static const auto path = fuzz::scratch_file();
  const auto before = fuzz::text_of(data, size);
  io::write_file(path, before);
  const bool refused = fuzz::refused([&] { lcm_io::LogWriter(path, {"tm-1", ""}, 1, 3); });
  if (refused) {
    fuzz::check(io::read_file(path) == before);
  } else {
    const lcm_io::EventLog log(path);
    std::uint64_t place = 0;
    while (const auto event = log.event_at(place)) place = event->end;
    fuzz::check(place == log.size());
  }
  std::filesystem::remove(path);
  return 0;
}
