#include "wordgaze/io/tensor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace wordgaze::io {
namespace {

const auto& entry(const auto& map, std::string_view kind, std::string_view name) {
  const auto found = map.find(name);
  if (found == map.end()) throw std::runtime_error(fmt::format("no {} '{}'", kind, name));
  return found->second;
}

}  // namespace

const Tensor& TensorMap::tensor(std::string_view name) const {
  return entry(tensors, "tensor", name);
}

const std::string& TensorMap::text(std::string_view name) const {
  return entry(metadata, "metadata entry", name);
}

std::string description(const Tensor& tensor) {
  constexpr std::array names{"F32", "F64", "I64", "U8"};  // in the order of Tensor::Values
  return fmt::format("{} [{}]", names[tensor.values.index()], fmt::join(tensor.shape, ", "));
}

}  // namespace wordgaze::io
