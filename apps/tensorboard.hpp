#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "output.hpp"
#include "wordgaze/io/event_file.hpp"
#include "wordgaze/policy/observer.hpp"

namespace wordgaze::apps {

/// The metrics of training for TensorBoard, by frames.
class TensorBoard final : public policy::Observer {
 public:
  TensorBoard(const std::filesystem::path& folder, std::optional<std::int64_t> goes_on_at)
      : file_(folder, goes_on_at) {}

  void on_update(const policy::UpdateRecord& update) override {
    for (const policy::Scalar& scalar : update.scalars) {
      file_.add(update.frames, scalar.name, scalar.value);
    }
    // Curves are no reason to end what they are the curves of.
    if (!said_ && !file_.problem().empty()) {
      note("warning: {}\n", file_.problem());
      said_ = true;
    }
  }

 private:
  io::EventFile file_;
  bool said_ = false;
};

}  // namespace wordgaze::apps
