#include "wordgaze/io/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <iostream>
#include <stdexcept>
#include <system_error>

namespace wordgaze::io {
namespace {

int output_error = 0;  // the first of standard output

}  // namespace

void secure_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free descriptor is the one that open() gives.
    const int opened = ::open("/dev/null", O_RDWR);
    if (opened >= 0 && opened != descriptor) {
      ::dup2(opened, descriptor);
      ::close(opened);
    }
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print(std::FILE* stream, std::string_view text) noexcept {
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
  if (!written && stream == stdout && output_error == 0) output_error = errno != 0 ? errno : EIO;
}

bool flush_standard_output() {
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (output_error == 0 && !(flushed && std::cout && std::ferror(stdout) == 0)) {
    // The cause of an earlier failure is forgotten by now, but what failed once fails again.
    const bool known = errno != 0 || ::write(STDOUT_FILENO, "\n", 1) != 1;
    output_error = known && errno != 0 ? errno : EIO;
  }
  if (output_error == EPIPE) return false;
  if (output_error != 0) {
    throw std::runtime_error(fmt::format("cannot write to standard output: {}",
                                         std::generic_category().message(output_error)));
  }
  return true;
}

}  // namespace wordgaze::io
