#pragma once
#include "wordgaze/core/types.hpp"

namespace wordgaze::nn {

/// `batch` sequences of `steps` steps, one column each, time-major: c = t * batch + b. Step t is
/// then one contiguous block, and layers without memory see steps * batch columns and no time at
/// all.
struct SequenceShape {
  Index steps = 0;
  Index batch = 0;

  Index columns() const { return steps * batch; }
  Index column(Index t, Index b) const { return t * batch + b; }
  /// The columns of step t.
  template <class M>
  auto block(M& m, Index t) const {
    return m.middleCols(t * batch, batch);
  }
  bool operator==(const SequenceShape&) const = default;
};

}  // namespace wordgaze::nn
