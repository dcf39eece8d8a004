#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "wordgaze/core/setting.hpp"

/// Settings with their C++ type erased: one flat list that the reader, the writer, `--set` and the
/// documentation share, so that none of them is a template.
namespace wordgaze::io {

/// A value as a user writes it, before it meets the setting that it is meant for.
using Value = std::variant<bool, std::int64_t, double, std::string>;

enum class Kind { section, boolean, integer, real, text, choice };

/// One setting, or the head of a section, of a live configuration object.
struct Option {
  std::string key;  ///< dotted: "ppo.clip"
  std::string_view description;
  Kind kind = Kind::section;
  double lowest = 0, highest = 0;           ///< inclusive; integer and real
  std::vector<std::string_view> choices{};  ///< the allowed names; choice
  std::string former_key{};                 ///< in older files; empty: none
  std::function<std::string()> text{};      ///< the current value, as TOML writes it
  std::function<bool(const Value&)>
      assign{};  ///< takes a value of this kind; false: it does not fit
};

/// "text", quoted and escaped as TOML's basic string.
std::string toml_string(std::string_view text);
/// The shortest digits that read back as the same number, with a point or an exponent.
std::string real_text(float value);
std::string real_text(double value);

namespace detail {

template <class M>
void bind(Option& option, M& member) {
  if constexpr (std::same_as<M, bool>) {
    option.kind = Kind::boolean;
    option.text = [&member] { return std::string(member ? "true" : "false"); };
    option.assign = [&member](const Value& value) {
      member = std::get<bool>(value);
      return true;
    };
  } else if constexpr (std::integral<M>) {
    option.kind = Kind::integer;
    option.text = [&member] { return std::to_string(member); };
    option.assign = [&member](const Value& value) {
      const auto number = std::get<std::int64_t>(value);
      if (!std::in_range<M>(number)) return false;
      member = static_cast<M>(number);
      return true;
    };
  } else if constexpr (std::floating_point<M>) {
    option.kind = Kind::real;
    option.text = [&member] { return real_text(member); };
    option.assign = [&member](const Value& value) {
      const auto number = static_cast<M>(std::get<double>(value));
      if (!std::isfinite(number)) return false;
      member = number;
      return true;
    };
  } else if constexpr (NamedEnum<M>) {
    option.kind = Kind::choice;
    const auto allowed = names(member);
    option.choices.assign(allowed.begin(), allowed.end());
    option.text = [&member] { return toml_string(name_of(member)); };
    option.assign = [&member, allowed](const Value& value) {
      const auto at = std::find(allowed.begin(), allowed.end(), std::get<std::string>(value));
      if (at == allowed.end()) return false;
      member = static_cast<M>(at - allowed.begin());
      return true;
    };
  } else {
    static_assert(std::same_as<M, std::string>, "not a type of setting, see core/setting.hpp");
    option.kind = Kind::text;
    option.text = [&member] { return toml_string(member); };
    option.assign = [&member](const Value& value) {
      member = std::get<std::string>(value);
      return true;
    };
  }
}

template <Section C>
void collect(C& config, const std::string& prefix, std::vector<Option>& options) {
  const auto each_setting = [](auto&& visit) {
    std::apply([&](const auto&... setting) { (visit(setting), ...); }, C::settings());
  };
  const auto named = [&](const auto& setting) {
    return Option{.key = prefix + std::string(setting.name),
                  .description = setting.description,
                  .lowest = setting.lowest,
                  .highest = setting.highest,
                  .former_key = setting.formerly.empty() ? std::string()
                                                         : prefix + std::string(setting.formerly)};
  };
  // Sections after plain settings: in TOML, a key belongs to the last [section] before it.
  each_setting([&](const auto& setting) {
    auto& member = config.*setting.member;
    if constexpr (!Section<std::remove_cvref_t<decltype(member)>>) {
      bind(options.emplace_back(named(setting)), member);
    }
  });
  each_setting([&](const auto& setting) {
    auto& member = config.*setting.member;
    if constexpr (Section<std::remove_cvref_t<decltype(member)>>) {
      options.push_back(named(setting));
      collect(member, options.back().key + ".", options);
    }
  });
}

}  // namespace detail

/// The settings of `config`, depth first, each section preceded by its head. The options refer to
/// `config`, which must stay where it is.
template <Section C>
std::vector<Option> options_of(C& config) {
  std::vector<Option> options;
  detail::collect(config, "", options);
  return options;
}

}  // namespace wordgaze::io
