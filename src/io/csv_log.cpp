#include "wordgaze/io/csv_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "wordgaze/core/require.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

std::string header_of(const std::vector<std::string>& columns) {
  return fmt::format("{}\n", fmt::join(columns, ","));
}

/// Counts exactly, measurements to single precision.
std::string number_text(double value) {
  const bool whole = std::trunc(value) == value && std::abs(value) < 1e15;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.7g}", value);
}

/// Cell `column` of a row with `columns` cells.
double cell(std::string_view row, std::size_t column, std::size_t columns) {
  if (std::ranges::count(row, ',') + 1 != static_cast<std::ptrdiff_t>(columns)) {
    throw std::runtime_error(fmt::format("expected {} values in the row '{}'", columns, row));
  }
  for (; column > 0; --column) row.remove_prefix(row.find(',') + 1);
  row = row.substr(0, row.find(','));
  double value = 0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), value);
  if (error != std::errc{} || end != row.data() + row.size()) {
    throw std::runtime_error(fmt::format("expected a number, came '{}'", row));
  }
  return value;
}

/// The header and the finished rows with key <= last.
std::string kept(std::string_view content, const std::vector<std::string>& columns,
                 std::size_t key_column, double last) {
  std::string result = header_of(columns);
  if (!content.starts_with(result)) {
    throw std::runtime_error(fmt::format("its header is '{}', expected '{}'",
                                         content.substr(0, content.find('\n')),
                                         result.substr(0, result.size() - 1)));
  }
  content.remove_prefix(result.size());
  for (std::size_t end; (end = content.find('\n')) != content.npos;
       content.remove_prefix(end + 1)) {
    const std::string_view row = content.substr(0, end);
    if (cell(row, key_column, columns.size()) <= last) result.append(row) += '\n';
  }
  return result;
}

}  // namespace

CsvLog::CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : CsvLog(path, columns, header_of(columns)) {}

CsvLog::CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns,
               std::string_view content)
    : path_(path), columns_(columns) {
  write_file(path, content);
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (!file_) {
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_.string(),
                                         std::generic_category().message(errno)));
  }
}

CsvLog CsvLog::resume(const std::filesystem::path& path, const std::vector<std::string>& columns,
                      std::string_view key, double last) {
  if (!std::filesystem::exists(path)) return {path, columns};
  const auto found = std::ranges::find(columns, key);
  require(found != columns.end(), "'{}' is not a column of '{}'", key, path.string());
  std::string content = read_file(path);
  try {
    content = kept(content, columns, static_cast<std::size_t>(found - columns.begin()), last);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("cannot go on with '{}': {}", path.string(), error.what()));
  }
  return {path, columns, content};
}

void CsvLog::append(std::span<const double> row) {
  require(row.size() == columns_.size(), "'{}' has {} columns; came {} values", path_.string(),
          columns_.size(), row.size());
  std::vector<std::string> cells(row.size());
  std::ranges::transform(row, cells.begin(), number_text);
  const std::string line = fmt::format("{}\n", fmt::join(cells, ","));
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() ||
      std::fflush(file_.get()) != 0) {
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_.string(),
                                         std::generic_category().message(errno)));
  }
}

}  // namespace wordgaze::io
