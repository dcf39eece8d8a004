#include "wordgaze/io/csv_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "wordgaze/core/number.hpp"
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

/// The cells of a row with `columns` cells.
std::vector<double> cells(std::string_view row, std::size_t columns) {
  if (std::ranges::count(row, ',') + 1 != static_cast<std::ptrdiff_t>(columns)) {
    throw std::runtime_error(
        fmt::format("expected {} values in the row '{}'", columns, shortened(row)));
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < columns; ++k) {
    const std::string_view cell = row.substr(0, row.find(','));
    const auto value = number_in<double>(cell);
    if (!value) {
      throw std::runtime_error(fmt::format("expected a number, came '{}'", shortened(cell)));
    }
    values.push_back(*value);
    row.remove_prefix(std::min(cell.size() + 1, row.size()));
  }
  return values;
}

void expect_header(std::string_view content, std::string_view header) {
  if (content.starts_with(header)) return;
  throw std::runtime_error(fmt::format("its header is '{}', expected '{}'",
                                       shortened(content.substr(0, content.find('\n'))),
                                       header.substr(0, header.size() - 1)));
}

/// The header and the finished rows with key <= last, as text and as numbers.
struct Kept {
  std::string text;
  std::vector<std::vector<double>> rows;
};

Kept kept(std::string_view content, const std::vector<std::string>& columns, std::size_t key,
          double last) {
  Kept result{.text = header_of(columns), .rows = {}};
  expect_header(content, result.text);
  content.remove_prefix(result.text.size());
  content = content.substr(0, content.find('\0'));  // what a power cut may have left
  for (std::size_t end; (end = content.find('\n')) != content.npos;
       content.remove_prefix(end + 1)) {
    const std::string_view row = content.substr(0, end);
    auto values = cells(row, columns.size());
    if (!(values[key] <= last)) continue;
    result.text.append(row) += '\n';
    result.rows.push_back(std::move(values));
  }
  return result;
}

/// Which rows are missing, if the key grows by equal steps: the smallest that occurs.
std::string gap_in(const std::vector<std::vector<double>>& rows, std::string_view name,
                   std::size_t key, double last) {
  if (rows.empty()) {
    return last > 0 ? fmt::format("there are no rows of {} up to {}", name, number_text(last)) : "";
  }
  double step = rows.front()[key];
  for (std::size_t i = 1; i < rows.size(); ++i) {
    step = std::min(step, rows[i][key] - rows[i - 1][key]);
  }
  if (!(step > 0)) return fmt::format("the rows are not in the order of {}", name);
  double before = 0;
  for (std::size_t i = 0; i <= rows.size(); ++i) {
    const double next = i < rows.size() ? rows[i][key] : last + step;
    if (next != before + step) {
      return fmt::format("rows between {} {} and {} are missing", name, number_text(before),
                         number_text(i < rows.size() ? next : last));
    }
    before = next;
  }
  return "";
}

/// The header alone, unless a file is there that is somebody else's.
std::string fresh(const std::filesystem::path& path, const std::vector<std::string>& columns) {
  const std::string header = header_of(columns);
  if (!std::filesystem::exists(path)) return header;
  const std::string content = read_file(path);
  if (content.empty()) return header;
  try {
    expect_header(content, header);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format(
        "cannot start '{}': a file of that name is there, and {}; move it away, or choose another "
        "folder",
        path.string(), error.what()));
  }
  return header;
}

}  // namespace

CsvLog::CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : CsvLog(path, columns, fresh(path, columns)) {}

CsvLog::CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns,
               std::string_view content)
    : path_(path), columns_(columns) {
  write_file(path, content);
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (!file_) fail();
}

void CsvLog::fail() const {
  throw std::runtime_error(
      fmt::format("cannot write '{}': {}", path_.string(), std::generic_category().message(errno)));
}

CsvLog CsvLog::resume(const std::filesystem::path& path, const std::vector<std::string>& columns,
                      std::string_view key, double last) {
  const auto found = std::ranges::find(columns, key);
  require(found != columns.end(), "'{}' is not a column of '{}'", key, path.string());
  const auto column = static_cast<std::size_t>(found - columns.begin());
  const bool exists = std::filesystem::exists(path);
  Kept rows{.text = header_of(columns), .rows = {}};
  try {
    if (exists) rows = kept(read_file(path), columns, column, last);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("cannot go on with '{}': {}", path.string(), error.what()));
  }
  CsvLog log(path, columns, rows.text);
  log.gap_ = gap_in(rows.rows, key, column, last);
  if (!exists && !log.gap_.empty()) log.gap_ = "the file is not there: " + log.gap_;
  if (!rows.rows.empty()) log.last_ = rows.rows.back();
  return log;
}

double CsvLog::last(std::string_view column) const {
  const auto found = std::ranges::find(columns_, column);
  require(found != columns_.end(), "'{}' is not a column of '{}'", column, path_.string());
  return last_.empty() ? 0 : last_[static_cast<std::size_t>(found - columns_.begin())];
}

void CsvLog::append(std::span<const double> row) {
  require(row.size() == columns_.size(), "'{}' has {} columns; came {} values", path_.string(),
          columns_.size(), row.size());
  std::vector<std::string> cells(row.size());
  std::ranges::transform(row, cells.begin(), number_text);
  const std::string line = fmt::format("{}\n", fmt::join(cells, ","));
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() ||
      std::fflush(file_.get()) != 0) {
    fail();
  }
}

void CsvLog::sync() {
  if (::fsync(::fileno(file_.get())) != 0) fail();
}

}  // namespace wordgaze::io
