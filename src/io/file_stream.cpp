#include "wordgaze/io/file_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw std::runtime_error(
      fmt::format("cannot write '{}': {}", path.string(), std::generic_category().message(error)));
}

bool reaches_the_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  return synced;
}

}  // namespace

FileStream::FileStream(const fs::path& path) : path_(path), temporary_(path) {
  if (fs::exists(path) && fs::is_regular_file(path)) path_ = fs::canonical(path);  // a link stays
  if (!fs::exists(path) || fs::is_regular_file(path)) {
    temporary_ = fmt::format("{}.{}.tmp", path_.string(), ::getpid());
  }
  errno = 0;
  file_.open(temporary_, std::ios::binary);
  if (!file_) fail(path_, errno);
}

FileStream::~FileStream() {
  std::error_code ignored;
  if (!whole_ && temporary_ != path_) fs::remove(temporary_, ignored);
}

void FileStream::check() {
  if (!file_) fail(path_, errno != 0 ? errno : EIO);
}

void FileStream::commit() {
  file_.flush();
  check();
  file_.close();
  check();
  if (temporary_ != path_) {
    if (!reaches_the_disk(temporary_) || ::rename(temporary_.c_str(), path_.c_str()) != 0) {
      fail(path_, errno);
    }
  }
  whole_ = true;
}

}  // namespace wordgaze::io
