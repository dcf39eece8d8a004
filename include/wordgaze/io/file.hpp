#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// Whole files, all or nothing.
namespace wordgaze::io {

/// The bytes of a file. Throws std::runtime_error that names the file and the cause.
std::string read_file(const std::filesystem::path& path);

/// Makes `parts`, one after the other, the content of the file at `path`, or leaves the old file as
/// it was: they go to a temporary file in the same folder, reach the disk, and only then take the
/// name. A pipe or a device (say /dev/stdout) is written directly. Throws std::runtime_error that
/// names the file and the cause (a full disk, a missing folder); no temporary file stays behind.
void write_file(const std::filesystem::path& path, std::span<const std::string_view> parts);
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace wordgaze::io
