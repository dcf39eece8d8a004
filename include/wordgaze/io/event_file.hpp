#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace wordgaze::io {

/// A file of scalars that TensorBoard reads: TFRecords of tensorflow.Event, the few fields that
/// scalars need. Each event is in the file when add() returns.
class EventFile {
 public:
  /// Starts a file in a folder, which is made if need be. A run that goes on has one more file:
  /// TensorBoard is told to forget the steps from `goes_on_at` on that an earlier file holds.
  /// Throws std::runtime_error that names the file and the cause.
  explicit EventFile(const std::filesystem::path& folder,
                     std::optional<std::int64_t> goes_on_at = {});

  /// A number at a step of training. What cannot be written is lost: see problem().
  void add(std::int64_t step, std::string_view tag, double value);

  const std::filesystem::path& path() const { return path_; }
  /// Why nothing is written any more; empty when all is well.
  const std::string& problem() const { return problem_; }

 private:
  void write(std::int64_t step, std::string_view rest_of_event);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::string problem_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace wordgaze::io
