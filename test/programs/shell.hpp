#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "support/temporary_folder.hpp"

namespace wordgaze {

/// A folder of its own in which commands run as a user types them, the programs on the path.
class Shell {
 public:
  struct Result {
    int status = 0;  ///< as $?: 128 + n for a program that signal n ended
    std::string out, err;
  };

  Result operator()(const std::string& command) const {
    write("command.sh", command);
    const std::string line = "cd '" + folder_.path().string() + "' && PATH='" + WORDGAZE_PROGRAMS +
                             "':\"$PATH\" bash command.sh >stdout.txt 2>stderr.txt </dev/null";
    const int raw = std::system(line.c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), read("stdout.txt"),
            read("stderr.txt")};
  }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
  }
  std::string read(const std::string& name) const {
    std::ostringstream content;
    content << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return content.str();
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

 private:
  TemporaryFolder folder_;
};

/// The program refused: it said why in one message that holds all of `parts`, and left with an
/// error of its own choice, not with a crash.
template <class... Parts>
::testing::AssertionResult refused(const Shell::Result& result, const Parts&... parts) {
  const auto failure = [&](const std::string& what) {
    return ::testing::AssertionFailure()
           << what << "\n  exit status " << result.status << "\n  standard error: " << result.err
           << "\n  standard output: " << result.out;
  };
  if (result.status == 0) return failure("it did not fail");
  if (result.status > 2) return failure("that is no exit status of a refusal");
  if (result.err.empty()) return failure("it said nothing");
  if (result.err.find('\n') != result.err.size() - 1) return failure("more than one line");
  std::string missing;
  ((result.err.find(parts) == std::string::npos ? missing += std::string(" '") + parts + "'"
                                                : missing),
   ...);
  return missing.empty() ? ::testing::AssertionSuccess() : failure("not said:" + missing);
}

}  // namespace wordgaze
