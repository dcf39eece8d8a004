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
    write("command.sh", "enable -n eval  # our program, not the builtin\n" + command);
    const std::string line = "cd '" + folder_.path().string() +
                             "' && PATH='" WORDGAZE_PROGRAMS
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
  const std::filesystem::path& folder() const { return folder_.path(); }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

 private:
  TemporaryFolder folder_;
};

inline std::string describe(const Shell::Result& result) {
  return "\n  exit status " + std::to_string(result.status) + "\n  standard error: " + result.err +
         "\n  standard output: " + result.out;
}

inline ::testing::AssertionResult succeeded(const Shell::Result& result) {
  if (result.status == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "it failed" << describe(result);
}

/// The program refused: it said why in a message that holds all of `parts`, and left with an error
/// of its own choice, not with a crash.
template <class... Parts>
::testing::AssertionResult refused(const Shell::Result& result, const Parts&... parts) {
  const auto failure = [&](const std::string& what) {
    return ::testing::AssertionFailure() << what << describe(result);
  };
  if (result.status == 0) return failure("it did not fail");
  if (result.status >= 126) return failure("that is a crash, or no program at all");
  std::string missing;
  const auto look_for = [&](const std::string& part) {
    if (result.err.find(part) == std::string::npos) missing += " '" + part + "'";
  };
  (look_for(parts), ...);
  return missing.empty() ? ::testing::AssertionSuccess() : failure("not said:" + missing);
}

}  // namespace wordgaze
