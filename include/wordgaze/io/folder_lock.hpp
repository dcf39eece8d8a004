#pragma once
#include <filesystem>

namespace wordgaze::io {

/// A folder that one program at a time works in: a lock on the file `.lock` in it, which the system
/// releases when the program ends, however it ends. On file systems without locks it does nothing.
class FolderLock {
 public:
  /// Throws std::runtime_error that names the folder while another program holds it, or when no
  /// file can be made in it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace wordgaze::io
