#include "wordgaze/io/output_check.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

#include "wordgaze/core/require.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

/// Where a path leads, through links, be there a file or not.
fs::path destination(fs::path path) {
  std::error_code error;
  constexpr int kMostLinks = 40;  // as the system has it; they may lead to what is not there yet
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, error); ++links) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  fs::path end = fs::weakly_canonical(path, error);
  return error ? path : end;
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;
  return fs::equivalent(a, b, error) || destination(a) == destination(b);
}

[[noreturn]] void fail(const NamedPath& output, int error) {
  throw std::runtime_error(fmt::format("{}: cannot write '{}': {}", output.option,
                                       output.path.string(),
                                       std::generic_category().message(error)));
}

void check_writable(const NamedPath& output) {
  const fs::path path = destination(output.path);
  std::error_code error;
  if (fs::is_directory(path, error)) fail(output, EISDIR);
  if (fs::exists(path, error)) {
    if (::access(path.c_str(), W_OK) != 0) fail(output, errno);
    if (!fs::is_regular_file(path, error)) return;
  }
  // Files are written beside their place: can the folder take one?
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) fail(output, fs::exists(folder, error) ? ENOTDIR : ENOENT);
  std::string trial = (folder / ".wordgaze-XXXXXX").string();
  const int descriptor = ::mkstemp(trial.data());
  if (descriptor < 0) fail(output, errno);
  ::close(descriptor);
  ::unlink(trial.c_str());
}

}  // namespace

void check_outputs(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs) {
  const auto differs = [](const NamedPath& output, const NamedPath& other) {
    require(other.path.empty() || !same_file(output.path, other.path),
            "{} '{}' is the file of {}, '{}': it would be overwritten; give another", output.option,
            output.path.string(), other.option, other.path.string());
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty()) continue;
    for (const auto& input : inputs) differs(outputs[i], input);
    for (const auto& other : outputs.first(i)) differs(outputs[i], other);
  }
  for (const auto& output : outputs) {
    if (!output.path.empty()) check_writable(output);
  }
}

}  // namespace wordgaze::io
