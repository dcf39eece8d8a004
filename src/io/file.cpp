#include "wordgaze/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "wordgaze/core/number.hpp"

namespace wordgaze::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(std::string_view verb, const fs::path& path, int error) {
  throw std::runtime_error(fmt::format("cannot {} '{}': {}", verb, path.string(),
                                       std::generic_category().message(error)));
}

/// A file descriptor that is closed on every way out.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;

  bool is_open() const { return fd_ >= 0; }
  bool write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }
  /// Stops behind the first `most` bytes.
  bool read_all(std::string& content, std::size_t most) {
    std::array<char, 1 << 16> buffer;
    while (content.size() <= most) {
      const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return count == 0;
      content.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return true;
  }
  mode_t kind() const { return status().st_mode & S_IFMT; }
  std::size_t size() const { return static_cast<std::size_t>(status().st_size); }
  /// From now on, reading waits for whoever writes.
  void wait_for_writers() { ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) & ~O_NONBLOCK); }
  bool sync() { return ::fsync(fd_) == 0; }
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  struct stat status() const {
    struct stat status {};
    ::fstat(fd_, &status);
    return status;
  }

  int fd_;
};

bool write_all(Descriptor& file, std::span<const std::string_view> parts) {
  for (const std::string_view part : parts) {
    if (!file.write(part)) return false;
  }
  return true;
}

void write_directly(const fs::path& path, std::span<const std::string_view> parts) {
  Descriptor file(path, O_WRONLY);
  if (!file.is_open() || !write_all(file, parts) || !file.close()) fail("write", path, errno);
}

constexpr std::string_view kTemporary = ".tmp";

void write_and_rename(const fs::path& path, std::span<const std::string_view> parts) {
  const fs::path temporary = fmt::format("{}.{}{}", path.string(), ::getpid(), kTemporary);
  // What has this name was left by a process of the same number, or leads elsewhere.
  ::unlink(temporary.c_str());
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (!file.is_open()) fail("write", path, errno);
  if (!write_all(file, parts) || !file.sync() || !file.close() ||
      ::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    fail("write", path, error);
  }
  // The new name itself is safe only when the folder is: a best effort, as some file systems
  // refuse.
  Descriptor folder(path.has_parent_path() ? path.parent_path() : fs::path("."),
                    O_RDONLY | O_DIRECTORY);
  if (folder.is_open()) folder.sync();
}

/// Opened without waiting for somebody to write into a pipe.
Descriptor opened(const fs::path& path) {
  Descriptor file(path, O_RDONLY | O_NONBLOCK);
  if (!file.is_open()) fail("read", path, errno);
  if (file.kind() == S_IFDIR) fail("read", path, EISDIR);
  file.wait_for_writers();
  return file;
}

void expect_regular(const Descriptor& file, const fs::path& path) {
  if (file.kind() == S_IFREG) return;
  throw std::runtime_error(
      fmt::format("cannot read '{}': a pipe or a device; expected a regular file", path.string()));
}

/// Whether "NAME.PID.tmp" was left by a process that is gone.
bool is_left_over(std::string_view file, std::string_view name) {
  if (!file.starts_with(name) || !file.ends_with(kTemporary)) return false;
  file.remove_prefix(name.size());
  if (file.size() <= kTemporary.size() || file[0] != '.') return false;
  const auto process = number_in<pid_t>(file.substr(1, file.size() - kTemporary.size() - 1));
  return process && *process > 0 && ::kill(*process, 0) != 0 && errno == ESRCH;
}

}  // namespace

std::string read_file(const fs::path& path) {
  Descriptor file = opened(path);
  expect_regular(file, path);
  std::string content;
  try {
    content.reserve(file.size());
    constexpr auto kNoLimit = std::numeric_limits<std::size_t>::max();
    if (!file.read_all(content, kNoLimit)) fail("read", path, errno);
  } catch (const std::bad_alloc&) {
    fail("read", path, ENOMEM);
  } catch (const std::length_error&) {
    fail("read", path, EFBIG);
  }
  return content;
}

std::string read_text(const fs::path& path, std::size_t most) {
  Descriptor file = opened(path);
  std::string content;
  if (!file.read_all(content, most)) fail("read", path, errno);
  if (content.size() > most) {
    throw std::runtime_error(
        fmt::format("cannot read '{}': more than {} bytes", path.string(), most));
  }
  if (content.empty() && file.kind() == S_IFIFO) {
    throw std::runtime_error(
        fmt::format("cannot read '{}': a pipe into which nobody writes", path.string()));
  }
  return content;
}

void expect_regular(const fs::path& path) { expect_regular(opened(path), path); }

void write_file(const fs::path& path, std::span<const std::string_view> parts) {
  if (!fs::exists(path)) return write_and_rename(path, parts);
  if (!fs::is_regular_file(path)) return write_directly(path, parts);
  write_and_rename(fs::canonical(path), parts);  // through a symbolic link, which stays
}

void write_file(const fs::path& path, std::string_view content) {
  write_file(path, std::span(&content, 1));
}

void clear_temporaries(const fs::path& folder, std::initializer_list<std::string_view> names) {
  std::error_code ignored;  // to clear is a courtesy
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    const auto left_over = [&](std::string_view name) { return is_left_over(file, name); };
    if (std::ranges::any_of(names, left_over) && !fs::is_directory(entry.symlink_status(ignored))) {
      fs::remove(entry.path(), ignored);
    }
  }
}

}  // namespace wordgaze::io
