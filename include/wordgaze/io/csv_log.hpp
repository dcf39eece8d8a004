#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wordgaze::io {

/// A table of numbers that grows by a row at a time; each row is in the file when append() returns.
class CsvLog {
 public:
  /// Starts a new file with a header. Throws std::runtime_error when it cannot be written, and for
  /// a file that is there already with another header: it is somebody else's.
  CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// Goes on with an existing file: keeps the rows whose `key` is at most `last` (a run that was
  /// interrupted may have written more than its checkpoint knows) and drops an unfinished last row.
  /// A file that is not there is started. Throws std::runtime_error when the header or a row is not
  /// as expected; the file is then unchanged.
  static CsvLog resume(const std::filesystem::path& path, const std::vector<std::string>& columns,
                       std::string_view key, double last);

  /// What resume() missed of a key that grows by equal steps from one step to `last`: "there are no
  /// rows of frames 128 to 640"; empty if nothing. To be said to the user.
  const std::string& gap() const { return gap_; }
  /// The value of a column in the last row that resume() has kept; 0 if there is none.
  double last(std::string_view column) const;

  /// One value a column, NaN written as "nan". Throws std::runtime_error when writing fails.
  void append(std::span<const double> row);

  /// Returns when all rows have reached the disk. Throws std::runtime_error when they cannot.
  void sync();

 private:
  CsvLog(const std::filesystem::path& path, const std::vector<std::string>& columns,
         std::string_view content);
  [[noreturn]] void fail() const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::string gap_;
  std::vector<double> last_;  // row
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace wordgaze::io
