#pragma once
#include <iosfwd>

namespace wordgaze::trace {

/// Writes docs/levels.md: every level with its size, missions and step limit. The forms of missions
/// are collected from episodes.
void write_level_docs(std::ostream& out);

}  // namespace wordgaze::trace
