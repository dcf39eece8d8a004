#pragma once
#include <string_view>
#include <vector>

#include "wordgaze/babyai/instruction.hpp"

namespace wordgaze::training {

/// Kinds of objects, a color and a type each, that missions of training never name: words that the
/// agent knows one by one meet for the first time when it is evaluated.
class HeldOut {
 public:
  HeldOut() = default;
  /// A list as "red ball, blue key"; nothing for "". Throws std::invalid_argument for what is not a
  /// color with key, ball or box.
  explicit HeldOut(std::string_view list);

  bool empty() const { return kinds_.empty(); }
  /// Whether a clause means an object by a color and type of the list.
  bool named_in(const babyai::Instruction& instruction) const;

 private:
  bool contains(const babyai::Description& description) const;

  std::vector<babyai::Description> kinds_;
};

}  // namespace wordgaze::training
