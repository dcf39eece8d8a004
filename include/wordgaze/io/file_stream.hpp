#pragma once
#include <filesystem>
#include <fstream>
#include <ostream>

namespace wordgaze::io {

/// A file that is written a piece at a time and takes its name when it is whole; until then, and
/// where it never is, the file that was there stays. A pipe or a device is written directly.
class FileStream {
 public:
  /// Throws std::runtime_error that names the file and the cause.
  explicit FileStream(const std::filesystem::path& path);
  ~FileStream();
  FileStream(const FileStream&) = delete;
  FileStream& operator=(const FileStream&) = delete;

  std::ostream& stream() { return file_; }
  /// Throws std::runtime_error that names the file and the cause when something could not be
  /// written so far.
  void check();
  /// The end: all of it is on the disk under its name.
  void commit();

 private:
  std::filesystem::path path_, temporary_;  // the same where it is written directly
  std::ofstream file_;
  bool whole_ = false;
};

}  // namespace wordgaze::io
