#pragma once
#include <cstdio>
#include <string_view>

/// Standard input, output and error of a program, which may be closed, full or a pipe that nobody
/// reads.
namespace wordgaze::io {

/// At the start of main: opens descriptors 0 to 2 on /dev/null where they are closed, so that no
/// file of ours ever takes their place. Writing to a pipe that nobody reads, or beyond the largest
/// size of a file, becomes an error in place of a signal that kills.
void secure_standard_streams();

/// Writes at once. What cannot be written is lost: no work ends for a line of text. Of standard
/// output that is remembered, for flush_standard_output().
void print(std::FILE* stream, std::string_view text) noexcept;

/// At the end of main: whether all of standard output, std::cout included, was written; false where
/// it is a pipe whose reader has gone. Throws std::runtime_error with any other cause.
bool flush_standard_output();

}  // namespace wordgaze::io
