#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace wordgaze::io {

/// A file that a program reads or writes, as an option names it. An empty path is none.
struct NamedPath {
  std::string_view option;
  std::filesystem::path path;
};

/// Before the work, so that its result has a place to go. Throws std::runtime_error where an output
/// cannot be written, std::invalid_argument where it is the same file as an input or another
/// output, by whatever name; devices such as /dev/null may be named twice. No file is changed.
void check_outputs(std::span<const NamedPath> outputs, std::span<const NamedPath> inputs);

}  // namespace wordgaze::io
