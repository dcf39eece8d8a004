#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace wordgaze {

/// Boundary check: throws std::invalid_argument with the formatted message unless `ok`.
/// The message says where, what was expected, what came and how to mend it.
template <class... Args>
void require(bool ok, fmt::format_string<Args...> message, Args&&... args) {
  if (!ok) throw std::invalid_argument(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace wordgaze
