#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

/// What fuzz targets share. A target is one function, LLVMFuzzerTestOneInput: built by clang with
/// -fsanitize=fuzzer it is searched for inputs that break something (scripts/fuzz), built with
/// driver.cpp it runs over the files of its corpus, as a test.
namespace wordgaze::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Whether `action` refuses with one of the errors that the library promises for bad input. Any
/// other exception ends the program, as a crash does.
template <class Action>
bool refused(Action&& action) {
  try {
    action();
    return false;
  } catch (const std::invalid_argument&) {
    return true;
  } catch (const std::runtime_error&) {
    return true;
  }
}

/// What must hold; ends the program if not.
inline void check(bool ok) {
  if (!ok) __builtin_trap();
}

/// A file of this process, for what is read from files alone; in memory where that can be.
inline std::filesystem::path scratch_file() {
  const std::filesystem::path shared = "/dev/shm";
  const auto folder =
      ::access(shared.c_str(), W_OK) == 0 ? shared : std::filesystem::temp_directory_path();
  return folder / ("wordgaze-fuzz-" + std::to_string(::getpid()));
}

}  // namespace wordgaze::fuzz
