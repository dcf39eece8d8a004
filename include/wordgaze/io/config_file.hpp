#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wordgaze/io/file.hpp"
#include "wordgaze/io/option.hpp"

/// Configurations as TOML files, for any aggregate with settings() (core/setting.hpp).
///
/// What a user wrote wrongly throws std::invalid_argument: "file:line: ", the key, what was
/// expected and what came; an unknown key comes with the nearest known one. A file that is missing
/// or cannot be read throws std::runtime_error. Either way nothing is changed.
namespace wordgaze::io {

/// Longer files are refused, as are those that nest without end.
inline constexpr std::size_t kMostConfigBytes = 1 << 20;

namespace detail {
void parse_into(std::span<const Option> options, std::string_view toml, std::string_view source);
void parse_section_into(std::span<const Option> options, std::string_view section,
                        std::string_view toml, std::string_view source);
void assign_into(std::span<const Option> options, std::string_view assignment);
std::string toml_text(std::span<const Option> options);
std::string markdown_text(std::span<const Option> options);
std::string key_named(std::string_view name, std::span<const Option> options);
std::vector<std::string> differences(std::span<const Option> a, std::span<const Option> b);
}  // namespace detail

/// `defaults` with what `toml` says. `source` is the name to blame in messages.
template <Section C>
C parse_config(std::string_view toml, std::string_view source, C defaults = {}) {
  detail::parse_into(options_of(defaults), toml, source);
  return defaults;
}

/// `defaults` with what one [section] of `toml` says; the others are somebody else's.
template <Section C>
C parse_section(std::string_view toml, std::string_view section, std::string_view source,
                C defaults = {}) {
  detail::parse_section_into(options_of(defaults), section, toml, source);
  return defaults;
}

/// The whole key of a setting by its last name: "ppo.epochs" for "epochs"; empty when there is none
/// or more than one.
template <Section C>
std::string key_named(std::string_view name, C defaults = {}) {
  return detail::key_named(name, options_of(defaults));
}

/// The text of one key outside of all sections, whatever else there is; empty without it.
std::string text_of(std::string_view key, std::string_view toml, std::string_view source);

/// `defaults` with what the file says, which may be a pipe too.
template <Section C>
C read_config(const std::filesystem::path& path, C defaults = {}) {
  return parse_config<C>(read_text(path, kMostConfigBytes), path.string(), std::move(defaults));
}

/// `assignment` is "section.key=value", the value as in TOML; text needs no quotes.
template <Section C>
void set_option(C& config, std::string_view assignment) {
  detail::assign_into(options_of(config), assignment);
}

/// The whole configuration with each description as a comment; parse_config reads back an equal
/// one.
template <Section C>
std::string to_toml(C config) {
  return detail::toml_text(options_of(config));
}

/// A reference of all settings: tables of key | default | range | description, one a section.
template <Section C>
std::string to_markdown(C defaults = {}) {
  return detail::markdown_text(options_of(defaults));
}

/// One line "key: value in a, value in b" for each setting in which the two disagree.
template <Section C>
std::vector<std::string> differences(C a, C b) {
  return detail::differences(options_of(a), options_of(b));
}

}  // namespace wordgaze::io
