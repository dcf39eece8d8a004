#pragma once
#include <filesystem>

#include "wordgaze/io/tensor.hpp"

/// Tensor files in the safetensors layout, which NumPy, PyTorch and others read: the length of a
/// JSON header (8 bytes, little-endian), the header (type, shape and place of each tensor), the
/// numbers. A checksum of everything stands in the metadata as "wordgaze.crc32" (docs/formats.md).
namespace wordgaze::io {

/// All or nothing, as write_file. Throws std::invalid_argument for a tensor whose shape and number
/// of values disagree or a reserved name, std::runtime_error when writing fails.
void write_safetensors(const std::filesystem::path& path, const TensorMap& content);

/// Throws std::runtime_error that names the file and what is wrong with it: not of this layout,
/// truncated, corrupted, or of a number type that is not supported. Nothing that the file says is
/// believed before it is checked. A file without checksum is read too: `checked` tells.
TensorMap read_safetensors(const std::filesystem::path& path, bool* checked = nullptr);

}  // namespace wordgaze::io
