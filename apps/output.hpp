#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "wordgaze/io/standard_streams.hpp"

namespace wordgaze::apps {

/// To standard output, at once; that it could not be written is noticed at the end of main.
template <class... Values>
void say(fmt::format_string<Values...> pattern, Values&&... values) {
  io::print(stdout, fmt::format(pattern, std::forward<Values>(values)...));
}

/// The same to standard error, where nobody need notice.
template <class... Values>
void note(fmt::format_string<Values...> pattern, Values&&... values) {
  io::print(stderr, fmt::format(pattern, std::forward<Values>(values)...));
}

}  // namespace wordgaze::apps
