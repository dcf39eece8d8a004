#pragma once
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>

/// Configuration as open data: an aggregate lists its settings once, in `settings()`; the reader,
/// the writer, `--set key=value` and the documentation all walk that list.
///
///     struct Limits {
///       int steps = 20;
///       static constexpr auto settings() {
///         return std::tuple{Setting{"steps", &Limits::steps, "steps of a rollout", 1, 4096}};
///       }
///     };
///
/// A member is bool, an integer, a floating-point number, std::string, an enum with a `names(E)`
/// overload (below), or another aggregate with `settings()`: a section.
namespace wordgaze {

template <class Owner, class Member>
struct Setting {
  std::string_view name;
  Member Owner::*member;
  std::string_view description;
  double lowest = -std::numeric_limits<double>::infinity();  ///< inclusive, numbers only
  double highest = std::numeric_limits<double>::infinity();  ///< inclusive, numbers only
};
template <class O, class M>
Setting(const char*, M O::*, const char*) -> Setting<O, M>;
template <class O, class M, class L, class H>
Setting(const char*, M O::*, const char*, L, H) -> Setting<O, M>;

template <class T>
concept Section = requires {
  T::settings();
};

/// An enum is a setting when argument-dependent lookup finds
/// `constexpr std::array<std::string_view, N> names(E)`: the name of value k at index k.
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires(E e) {
  names(e).size();
};

template <NamedEnum E>
constexpr std::string_view name_of(E value) {
  return names(value)[static_cast<std::size_t>(value)];
}

}  // namespace wordgaze
