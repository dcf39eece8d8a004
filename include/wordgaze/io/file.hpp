#pragma once
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

/// Whole files, all or nothing.
namespace wordgaze::io {

/// The bytes of a regular file. Throws std::runtime_error that names the file and the cause; also
/// for pipes and devices, which may have no end.
std::string read_file(const std::filesystem::path& path);

/// The same of what a user wrote, which may come through a pipe or a device too, as /dev/stdin and
/// bash's <(...) do, but has at most `most` bytes. Throws std::runtime_error for more, and for a
/// pipe that nobody writes into.
std::string read_text(const std::filesystem::path& path, std::size_t most);

/// Throws std::runtime_error unless the path leads to a regular file.
void expect_regular(const std::filesystem::path& path);

/// Makes `parts`, one after the other, the content of the file at `path`, or leaves the old file as
/// it was: they go to a temporary file in the same folder, reach the disk, and only then take the
/// name. A pipe or a device (say /dev/stdout) is written directly. Throws std::runtime_error that
/// names the file and the cause (a full disk, a missing folder); no temporary file stays behind.
void write_file(const std::filesystem::path& path, std::span<const std::string_view> parts);
void write_file(const std::filesystem::path& path, std::string_view content);

/// Removes what killed processes left of write_file() of these files of a folder: "NAME.PID.tmp",
/// where no process of that number runs. A folder that is not there has none.
void clear_temporaries(const std::filesystem::path& folder,
                       std::initializer_list<std::string_view> names);

}  // namespace wordgaze::io
