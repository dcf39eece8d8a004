#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

/// NumPy's arrays as spans, and values as NumPy's arrays.
namespace wordgaze::python {

/// An array of the caller that is read or written in place: bind it with noconvert(), so that
/// nobody writes into a copy.
template <class T, class... Shape>
using Array = nanobind::ndarray<T, nanobind::c_contig, nanobind::device::cpu, Shape...>;

/// All numbers of an array, one behind the other.
template <class T, class... Shape>
std::span<T> span_of(const Array<T, Shape...>& array) {
  return {array.data(), array.size()};
}

/// NumPy's booleans are the bytes 0 and 1.
inline std::span<std::uint8_t> bytes_of(const Array<bool, nanobind::ndim<1>>& array) {
  return {reinterpret_cast<std::uint8_t*>(array.data()), array.size()};
}

/// A new array of NumPy's that owns a vector's numbers.
template <class T>
auto array_of(std::vector<T> numbers, std::initializer_list<std::size_t> shape) {
  auto* owned = new std::vector<T>(std::move(numbers));
  const nanobind::capsule owner(owned,
                                [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nanobind::ndarray<nanobind::numpy, T>(owned->data(), shape, owner);
}

/// What is in a bytes object.
inline std::span<const std::uint8_t> span_of(const nanobind::bytes& bytes) {
  return {static_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}
inline nanobind::bytes bytes_object(std::span<const std::uint8_t> bytes) {
  return nanobind::bytes(bytes.data(), bytes.size());
}

}  // namespace wordgaze::python
