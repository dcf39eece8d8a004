#pragma once
#include <Eigen/Core>

/// Names that every module shares. A sample is a column; features run down it
/// (docs/architecture.md).
namespace wordgaze {

using Index = Eigen::Index;

template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Arguments of layers: bind to matrices and column blocks without a copy.
template <class S>
using In = const Eigen::Ref<const Matrix<S>>&;
template <class S>
using Out = Eigen::Ref<Matrix<S>>;

}  // namespace wordgaze
