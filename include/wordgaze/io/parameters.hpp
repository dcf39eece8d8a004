#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "wordgaze/io/tensor.hpp"
#include "wordgaze/nn/parameters.hpp"

/// Trees of parameters as named tensors.
namespace wordgaze::io {

/// Throws std::runtime_error that names the tensor for numbers that are not finite: they would take
/// the place of better ones.
template <nn::Tree P>
void put_parameters(TensorMap& map, const std::string& prefix, const P& params) {
  nn::for_each_parameter(
      [&](const nn::Path& path, const auto& leaf) {
        if (leaf.size() == 0) return;
        const std::string name = prefix + path.str();
        expect_finite(name, leaf);
        map.tensors.emplace(name, tensor_of(leaf));
      },
      params);
}

/// Fills a tree that has its sizes. Where optional(path) holds, a tensor may be missing: the leaf
/// then stays as it is. The vocabulary grows at its end, so leaves named `words` may have fewer
/// columns: those of newer words stay as they are. Throws std::runtime_error that names the tensor
/// for anything else.
template <nn::Tree P, class Optional>
void get_parameters(const TensorMap& map, const std::string& prefix, Optional&& optional,
                    P& params) {
  nn::for_each_parameter(
      [&](const nn::Path& path, auto& leaf) {
        const std::string name = prefix + path.str();
        if (leaf.size() == 0 || (optional(path) && !map.tensors.contains(name))) return;
        if constexpr (!std::remove_cvref_t<decltype(leaf)>::IsVectorAtCompileTime) {
          const Tensor& tensor = map.tensor(name);
          if (path.names[path.depth - 1] == "words" && tensor.shape.size() == 2 &&
              tensor.shape[1] < leaf.cols()) {
            std::remove_cvref_t<decltype(leaf)> known(leaf.rows(), tensor.shape[1]);
            copy_tensor(map, name, known);
            leaf.leftCols(known.cols()) = known;
            return;
          }
        }
        copy_tensor(map, name, leaf);
        if (path.names[path.depth - 1] == "focus" && (leaf.minCoeff() < 0 || leaf.maxCoeff() > 1)) {
          throw std::runtime_error(
              formatted("{} is {}; expected a share in [0, 1]", name, leaf(0)));
        }
      },
      params);
}

}  // namespace wordgaze::io
