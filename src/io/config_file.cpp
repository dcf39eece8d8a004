#include "wordgaze/io/config_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

// What toml++ asserts of its input is an error of the text, in every build: 3.3 asserts "[= x"
// away.
[[noreturn]] static void fail_assertion() { throw std::invalid_argument("a key is missing"); }
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) ((expr) ? void() : fail_assertion())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "wordgaze/core/edit_distance.hpp"
#include "wordgaze/core/number.hpp"
#include "wordgaze/core/require.hpp"

namespace wordgaze::io {
namespace detail {
namespace {

using Options = std::span<const Option>;

/// The allowed values: "[1, 4096]", "[0, inf]", "none, linear"; empty if any value will do.
std::string range_text(const Option& option) {
  if (option.kind == Kind::choice) return fmt::format("{}", fmt::join(option.choices, ", "));
  const bool number = option.kind == Kind::integer || option.kind == Kind::real;
  const bool bounded = std::isfinite(option.lowest) || std::isfinite(option.highest);
  return number && bounded ? fmt::format("[{}, {}]", option.lowest, option.highest) : "";
}

std::string expected_text(const Option& option) {
  const auto in_range = [&](std::string_view type) {
    const std::string range = range_text(option);
    return range.empty() ? std::string(type) : fmt::format("{} in the range {}", type, range);
  };
  switch (option.kind) {
    case Kind::section:
      return "a section";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return in_range("an integer");
    case Kind::real:
      return in_range("a number");
    case Kind::text:
      return "text";
    case Kind::choice:
      return "one of " + range_text(option);
  }
  return "";
}

std::string value_text(const Value& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using V = std::remove_cvref_t<decltype(v)>;
        if constexpr (std::same_as<V, std::string>) return "the text " + toml_string(shortened(v));
        if constexpr (std::same_as<V, bool>) return v ? "true" : "false";
        if constexpr (std::same_as<V, double>) return "the number " + real_text(v);
        if constexpr (std::same_as<V, std::int64_t>) return fmt::format("the integer {}", v);
      },
      value);
}

std::string last_name(std::string_view key) {
  return std::string(key.substr(key.rfind('.') + 1));  // npos + 1 == 0: the whole key
}

/// The known key that was probably meant: one of a similar name, be it in another section.
std::string meant(std::string_view written, Options options) {
  std::string_view best;
  std::size_t least = std::string_view::npos;
  for (const Option& option : options) {
    const std::size_t distance =
        std::min(edit_distance(written, option.key),
                 edit_distance(last_name(written), last_name(option.key)) + 1);
    if (distance < least) {
      least = distance;
      best = option.key;
    }
  }
  return std::string(best);
}

const Option& find(Options options, std::string_view key, std::string_view where) {
  const auto found = std::ranges::find_if(options, [&](const Option& option) {
    return option.key == key || (!option.former_key.empty() && option.former_key == key);
  });
  require(found != options.end(), "{}: unknown key '{}'; did you mean '{}'?", where, shortened(key),
          meant(key, options));
  return *found;
}

/// What the option's kind makes of the value: an integer will do for a number; else only its own
/// type.
std::optional<Value> converted(const Value& value, Kind kind) {
  if (kind == Kind::real && std::holds_alternative<std::int64_t>(value)) {
    return static_cast<double>(std::get<std::int64_t>(value));
  }
  const bool same =
      (kind == Kind::boolean && std::holds_alternative<bool>(value)) ||
      (kind == Kind::integer && std::holds_alternative<std::int64_t>(value)) ||
      (kind == Kind::real && std::holds_alternative<double>(value)) ||
      ((kind == Kind::text || kind == Kind::choice) && std::holds_alternative<std::string>(value));
  return same ? std::optional(value) : std::nullopt;
}

bool within_range(const Value& value, const Option& option) {
  const auto within = [&](double v) { return v >= option.lowest && v <= option.highest; };
  if (option.kind == Kind::integer) {
    return within(static_cast<double>(std::get<std::int64_t>(value)));
  }
  return option.kind != Kind::real || within(std::get<double>(value));  // false for NaN
}

void assign(const Option& option, const Value& value, std::string_view where) {
  const std::optional<Value> right = converted(value, option.kind);
  require(right && within_range(*right, option) && option.assign(*right),
          "{}: {}: expected {}; came {}", where, option.key, expected_text(option),
          value_text(value));
}

/// A list of texts is a text of as many lines.
std::optional<Value> lines(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr) return std::nullopt;
  std::string text;
  for (const auto& entry : *list) {
    const auto* line = entry.as_string();
    if (line == nullptr) return std::nullopt;
    if (!text.empty()) text += '\n';
    text += line->get();
  }
  return text;
}

std::optional<Value> scalar(const toml::node& node) {
  if (const auto* v = node.as_boolean()) return Value(v->get());
  if (const auto* v = node.as_integer()) return Value(v->get());
  if (const auto* v = node.as_floating_point()) return Value(v->get());
  if (const auto* v = node.as_string()) return Value(v->get());
  return std::nullopt;
}

void assign_table(Options options, const toml::table& table, const std::string& prefix,
                  std::string_view source) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    const std::string where = fmt::format("{}:{}", source, name.source().begin.line);
    const Option& option = find(options, key, where);
    if (option.kind == Kind::section) {
      require(node.is_table(), "{}: {}: expected a section; came the value of one setting", where,
              key);
      assign_table(options, *node.as_table(), key + ".", source);
    } else {
      const std::optional<Value> value =
          option.kind == Kind::text && node.is_array() ? lines(node) : scalar(node);
      require(value.has_value(), "{}: {}: expected {}; came {}", where, key, expected_text(option),
              node.is_table() ? "a section" : "a list or a date");
      assign(option, *value, where);
    }
  }
}

/// Behind the string that begins at `begin` with a quote: one line, or any number between three
/// quotes.
std::size_t end_of_string(std::string_view toml, std::size_t begin) {
  const char quote = toml[begin];
  const std::string three(3, quote);
  const bool lines = toml.substr(begin).starts_with(three);
  for (std::size_t i = begin + (lines ? 3 : 1); i < toml.size(); ++i) {
    if (toml[i] == '\\' && quote == '"') {
      ++i;
    } else if (lines && toml.substr(i).starts_with(three)) {
      i += 3;  // two more are the end of the text
      for (int more = 0; more < 2 && i < toml.size() && toml[i] == quote; ++more) ++i;
      return i;
    } else if (!lines && (toml[i] == quote || toml[i] == '\n')) {
      return i + 1;
    }
  }
  return toml.size();
}

/// Calls f(place) for each character outside of texts and comments.
template <class F>
void for_each_bare(std::string_view toml, F&& f) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::size_t i = toml.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  while (i < toml.size()) {
    if (toml[i] == '#') {
      i = std::min(toml.find('\n', i), toml.size());
    } else if (toml[i] == '"' || toml[i] == '\'') {
      i = end_of_string(toml, i);
    } else {
      f(i++);
    }
  }
}

/// Lists, tables and the parts of a key nest, and the parser recurs: no configuration of ours comes
/// near these bounds.
void check_bounds(std::string_view toml, std::string_view source) {
  constexpr int kMostNesting = 2000;
  require(toml.size() <= kMostConfigBytes, "{}: {} bytes; a configuration has at most {}", source,
          toml.size(), kMostConfigBytes);
  int nesting = 0;
  for_each_bare(
      toml, [&](std::size_t i) { nesting += toml[i] == '.' || toml[i] == '[' || toml[i] == '{'; });
  require(nesting <= kMostNesting,
          "{}: more than {} dots and opening brackets; a configuration has fewer", source,
          kMostNesting);
}

/// TOML has letters beyond ASCII in texts and comments alone. toml++ 3.3 has undefined behavior for
/// some of those that stand elsewhere: it asks whether they are white space.
void check_letters(std::string_view toml, std::string_view source) {
  for_each_bare(toml, [&](std::size_t i) {
    if (static_cast<unsigned char>(toml[i]) < 0x80) return;
    throw std::invalid_argument(fmt::format(
        "{}:{}: not valid TOML: a letter beyond ASCII outside quotes; put text in quotes", source,
        1 + std::ranges::count(toml.substr(0, i), '\n')));
  });
}

toml::table parsed(std::string_view toml, std::string_view source) {
  check_bounds(toml, source);
  check_letters(toml, source);
  try {
    return toml::parse(toml);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(fmt::format("{}:{}: not valid TOML: {}", source,
                                            error.source().begin.line,
                                            shortened(error.description(), 300)));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: not valid TOML: {}", source, error.what()));
  }
}

/// What follows "key=" on a command line: TOML where it is TOML, else the bare text.
Value command_line_value(std::string_view text, Kind kind) {
  Value bare = std::string(text);
  const auto whole = whole_number_in<std::int64_t>(text);
  if (kind == Kind::integer && whole) return *whole;
  check_bounds(text, "--set");
  try {
    const toml::table table = parsed("value = " + std::string(text), "--set");
    const std::optional<Value> value = scalar(*table.get("value"));
    const bool usable = table.size() == 1 && value &&
                        ((kind != Kind::text && kind != Kind::choice) ||
                         std::holds_alternative<std::string>(*value));
    return usable ? *value : bare;
  } catch (const std::invalid_argument&) {
    return bare;
  }
}

}  // namespace

void parse_into(Options options, std::string_view toml, std::string_view source) {
  assign_table(options, parsed(toml, source), "", source);
}

void parse_section_into(Options options, std::string_view section, std::string_view toml,
                        std::string_view source) {
  const toml::table table = parsed(toml, source);
  if (const toml::table* part = table[section].as_table()) {
    assign_table(options, *part, "", source);
  }
}

void assign_into(Options options, std::string_view assignment) {
  const std::string where = fmt::format("--set {}", shortened(assignment));
  const std::size_t equals = std::min(assignment.find('='), assignment.size());
  require(equals > 0, "{}: expected section.key=value", where);
  const Option& option = find(options, assignment.substr(0, equals), where);
  require(option.kind != Kind::section, "{}: {} is a section; set one of its keys, as {}.key=value",
          where, option.key, option.key);
  require(equals < assignment.size(), "{}: without a value; expected {}, as in --set {}={}", where,
          expected_text(option), option.key, option.text());
  assign(option, command_line_value(assignment.substr(equals + 1), option.kind), where);
}

std::string toml_text(Options options) {
  std::string out;
  for (const Option& option : options) {
    if (option.kind == Kind::section) {
      out += fmt::format("\n# {}\n[{}]\n", option.description, option.key);
      continue;
    }
    const std::string range = range_text(option);
    out += fmt::format("# {}{}\n{} = {}\n", option.description, range.empty() ? "" : "; " + range,
                       last_name(option.key), option.text());
  }
  return out;
}

std::string key_named(std::string_view name, Options options) {
  std::string key;
  for (const Option& option : options) {
    if (option.kind == Kind::section || last_name(option.key) != name) continue;
    if (!key.empty()) return "";
    key = option.key;
  }
  return key;
}

std::string markdown_text(Options options) {
  constexpr std::string_view head = "| key | default | range | description |\n|---|---|---|---|\n";
  std::string out(options.empty() || options.front().kind == Kind::section ? "" : head);
  for (const Option& option : options) {
    if (option.kind == Kind::section) {
      out += fmt::format("\n### {}\n\n{}\n\n{}", option.key, option.description, head);
    } else {
      out += fmt::format("| `{}` | `{}` | {} | {} |\n", option.key, option.text(),
                         range_text(option), option.description);
    }
  }
  return out;
}

std::vector<std::string> differences(Options a, Options b) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].kind == Kind::section || a[i].text() == b[i].text()) continue;
    lines.push_back(fmt::format("{}: {} in the first, {} in the second", a[i].key,
                                shortened(a[i].text()), shortened(b[i].text())));
  }
  return lines;
}

}  // namespace detail

std::string text_of(std::string_view key, std::string_view toml, std::string_view source) {
  return detail::parsed(toml, source)[key].value_or(std::string());
}

}  // namespace wordgaze::io
