#include "wordgaze/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

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
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

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
  bool read_all(std::string& content) {
    std::array<char, 1 << 16> buffer;
    for (;;) {
      const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return count == 0;
      content.append(buffer.data(), static_cast<std::size_t>(count));
    }
  }
  bool sync() { return ::fsync(fd_) == 0; }
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
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

void write_and_rename(const fs::path& path, std::span<const std::string_view> parts) {
  const fs::path temporary = fmt::format("{}.{}.tmp", path.string(), ::getpid());
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
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

}  // namespace

std::string read_file(const fs::path& path) {
  Descriptor file(path, O_RDONLY);
  std::string content;
  if (!file.is_open() || !file.read_all(content)) fail("read", path, errno);
  return content;
}

void write_file(const fs::path& path, std::span<const std::string_view> parts) {
  if (!fs::exists(path)) return write_and_rename(path, parts);
  if (!fs::is_regular_file(path)) return write_directly(path, parts);
  write_and_rename(fs::canonical(path), parts);  // through a symbolic link, which stays
}

void write_file(const fs::path& path, std::string_view content) {
  write_file(path, std::span(&content, 1));
}

}  // namespace wordgaze::io
