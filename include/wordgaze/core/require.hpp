#pragma once
#include <stdexcept>
#include <utility>

#include "wordgaze/core/formatted.hpp"

namespace wordgaze {

/// Boundary check: throws std::invalid_argument with the formatted message unless `ok`.
/// The message says where, what was expected, what came and how to mend it.
template <class... Values>
void require(bool ok, Pattern<sizeof...(Values)> message, const Values&... values) {
  if (!ok) throw std::invalid_argument(formatted(message, values...));
}

}  // namespace wordgaze
