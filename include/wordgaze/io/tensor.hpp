#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/types.hpp"

namespace wordgaze::io {

/// Numbers of one type with a shape, row-major as in NumPy; an empty shape is a single number.
struct Tensor {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int64_t>,
                              std::vector<std::uint8_t>>;
  std::vector<std::int64_t> shape;
  Values values;

  bool operator==(const Tensor&) const = default;
};

/// Tensors and texts by name: what one file holds.
struct TensorMap {
  std::map<std::string, Tensor, std::less<>> tensors;
  std::map<std::string, std::string, std::less<>> metadata;

  /// Throws std::runtime_error when there is none of that name.
  const Tensor& tensor(std::string_view name) const;
  const std::string& text(std::string_view name) const;

  bool operator==(const TensorMap&) const = default;
};

/// "F32 [512, 128]"
std::string description(const Tensor& tensor);

/// A matrix as a tensor [rows, columns], a vector as [size].
template <class M>
Tensor tensor_of(const Eigen::MatrixBase<M>& matrix) {
  std::vector<typename M::Scalar> values;
  values.reserve(static_cast<std::size_t>(matrix.size()));
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (Index column = 0; column < matrix.cols(); ++column) values.push_back(matrix(row, column));
  }
  if constexpr (M::IsVectorAtCompileTime) return {{matrix.size()}, std::move(values)};
  return {{matrix.rows(), matrix.cols()}, std::move(values)};
}

/// The numbers of a tensor whose type and shape are known. Throws std::runtime_error that names the
/// tensor, what was expected and what came.
template <class S>
const std::vector<S>& values_of(const TensorMap& map, std::string_view name,
                                const std::vector<std::int64_t>& shape) {
  const Tensor& tensor = map.tensor(name);
  const auto* values = std::get_if<std::vector<S>>(&tensor.values);
  if (values == nullptr || tensor.shape != shape) {
    throw std::runtime_error(std::string(name) + " is " + description(tensor) + ", expected " +
                             description({shape, std::vector<S>{}}));
  }
  return *values;
}

/// Throws std::runtime_error that names the matrix unless all its numbers are finite.
template <class M>
void expect_finite(std::string_view name, const Eigen::DenseBase<M>& matrix) {
  if (matrix.allFinite()) return;
  for (Index column = 0; column < matrix.cols(); ++column) {
    for (Index row = 0; row < matrix.rows(); ++row) {
      const auto value = matrix(row, column);
      if (std::isfinite(value)) continue;
      throw std::runtime_error(
          formatted("{}[{}, {}] is {}; expected finite numbers", name, row, column, value));
    }
  }
}

/// Copies a tensor into a matrix of the right size. Throws as values_of, and for numbers that are
/// not finite.
template <class M>
void copy_tensor(const TensorMap& map, std::string_view name, Eigen::PlainObjectBase<M>& matrix) {
  std::vector<std::int64_t> shape{matrix.rows(), matrix.cols()};
  if constexpr (M::IsVectorAtCompileTime) shape = {matrix.size()};
  auto value = values_of<typename M::Scalar>(map, name, shape).begin();
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (Index column = 0; column < matrix.cols(); ++column) matrix(row, column) = *value++;
  }
  expect_finite(name, matrix);
}

}  // namespace wordgaze::io
