#include "wordgaze/trace/replay.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <istream>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "records.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/nesting.hpp"

namespace wordgaze::trace {
namespace {

constexpr int kMismatchesShown = 5;

class Replay {
 public:
  explicit Replay(std::ostream& details) : details_(details) {}

  void take(const Json& record) {
    const std::string& type = record.at("t").get_ref<const std::string&>();
    if (type == "meta") {
      enum_actions_ = record.value("enum_actions", false);
    } else if (type == "reset") {
      take_reset(record);
    } else if (type == "step") {
      take_step(record);
    } else {
      throw std::runtime_error(fmt::format("a record of type '{}'", shortened(type)));
    }
  }

  ReplayReport report() const {
    ReplayReport result = report_;
    result.envs = static_cast<int>(ids_.size());
    return result;
  }

 private:
  void take_reset(const Json& theirs) {
    const Json& seed = theirs.at("seed");
    if (!seed.is_null()) {
      open(theirs);
      lost_ = false;
    }
    if (lost_) return;
    if (!env_) throw std::runtime_error("a stream that continues before it was seeded");
    // A seed beyond 64 bits is a string of digits.
    if (seed.is_string()) {
      env_->reset(core::Seed::parse(seed.get<std::string>()));
    } else if (!seed.is_null()) {
      if (!seed.is_number_unsigned()) {
        throw std::runtime_error(
            fmt::format("seed {}; expected a non-negative integer", seed.dump()));
      }
      env_->reset(seed.get<std::uint64_t>());
    } else {
      env_->reset();
    }
    chain_ = theirs.value("chain", Json());
    episode_ = theirs.value("ep", Json());
    ++report_.resets;
    compare(reset_record(*env_), theirs);
  }

  void take_step(const Json& theirs) {
    if (lost_) return;
    if (!env_) throw std::runtime_error("a step before the first reset");
    const Json& number = theirs.at("a");
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= grid::kActions) {
      throw std::runtime_error(fmt::format("action {}; expected 0 to 6", number.dump()));
    }
    const auto action = static_cast<grid::Action>(number.get<int>());
    const env::Transition transition = env_->step(action);
    ++report_.steps;
    compare(step_record(*env_, action, transition), theirs);
  }

  void open(const Json& theirs) {
    const auto id = theirs.at("env").get<std::string>();
    const bool done_actions = theirs.value("done_actions", false);
    if (env_ && env_->id() == id && done_actions_ == done_actions) return;
    babyai::LevelSpec level = babyai::find_level(id);
    if (done_actions && level.done_mode == babyai::DoneMode::off) {
      level.done_mode = enum_actions_ ? babyai::DoneMode::exact_enum : babyai::DoneMode::exact;
    }
    env_.emplace(level);
    done_actions_ = done_actions;
    ids_.insert(id);
  }

  // Every field of ours that they have as well.
  void compare(Json ours, const Json& theirs) {
    if (theirs.contains("image_crc")) ours["image_crc"] = image_checksum(*env_);
    if (theirs.contains("grid_crc")) ours["grid_crc"] = grid_checksum(*env_);
    for (const auto& [key, value] : ours.items()) {
      const auto other = theirs.find(key);
      if (other == theirs.end() || equal(key, value, *other)) continue;
      if (!lost_ && report_.mismatches++ < kMismatchesShown) {
        fmt::print(details_, "{} of seed {}, episode {}, step {}:\n", env_->id(), chain_.dump(),
                   episode_.dump(), env_->step_count());
      }
      lost_ = true;
      if (report_.mismatches <= kMismatchesShown) {
        fmt::print(details_, "  {} is {}, the trace has {}\n", key, value.dump(), other->dump());
      }
    }
  }

  static bool equal(const std::string& key, const Json& ours, const Json& theirs) {
    if (key != "rng") return ours == theirs;
    // What is left in the buffer after its use is no part of the state.
    return ours["state"] == theirs.at("state") && ours["inc"] == theirs.at("inc") &&
           ours["has32"] == theirs.at("has32") &&
           (ours["has32"] == 0 || ours["buf32"] == theirs.at("buf32"));
  }

  std::ostream& details_;
  std::optional<env::Environment> env_;
  std::set<std::string> ids_;
  bool done_actions_ = false, enum_actions_ = false;
  bool lost_ = false;  // a mismatch in this stream: what follows says nothing
  Json chain_, episode_;
  ReplayReport report_;
};

[[noreturn]] void fail(std::int64_t line, std::string_view what) {
  throw std::runtime_error(fmt::format("trace, line {}: {}", line, shortened(what, 500)));
}

/// As std::getline, of lines that end.
bool next_line(std::istream& in, std::string& line, std::int64_t number) {
  constexpr std::size_t kLongest = 16 << 20;  // a grid of the largest level is a third of it
  constexpr auto kEnd = std::istream::traits_type::eof();
  line.clear();
  auto c = in.rdbuf()->sbumpc();
  if (c == kEnd) return false;
  for (; c != kEnd && c != '\n'; c = in.rdbuf()->sbumpc()) {
    line += static_cast<char>(c);
    if (line.size() > kLongest) fail(number, "longer than 16 MiB");
  }
  return true;
}

Json parsed(std::string_view line) {
  constexpr int kDeepest = 100;  // more than the longest instruction and the most boxes in boxes
  if (json_nesting(line) > kDeepest) throw std::runtime_error("nested too deeply");
  return Json::parse(line);
}

}  // namespace

ReplayReport replay(std::istream& in, std::ostream& details) {
  Replay replay(details);
  std::string line;
  for (std::int64_t number = 1; next_line(in, line, number); ++number) {
    try {
      replay.take(parsed(line));
    } catch (const Json::exception& error) {
      fail(number, error.what());
    } catch (const std::runtime_error& error) {
      fail(number, error.what());
    }
  }
  if (in.bad()) throw std::runtime_error("the trace cannot be read");
  const ReplayReport report = replay.report();
  if (report.resets == 0) {
    throw std::runtime_error("no episode begins in the trace, so nothing was compared");
  }
  return report;
}

}  // namespace wordgaze::trace
