#include "wordgaze/io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace wordgaze::io {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(
          ::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)) {
  if (descriptor_ < 0) {
    throw std::runtime_error(fmt::format("cannot write into '{}': {}", folder.string(),
                                         std::generic_category().message(errno)));
  }
  // The file stays when the lock goes: a name that is removed could be locked twice.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    throw std::runtime_error(
        fmt::format("another program is at work in '{}'; wait until it has ended, or give another "
                    "folder",
                    folder.string()));
  }
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace wordgaze::io
