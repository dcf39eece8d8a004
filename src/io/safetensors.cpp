#include "wordgaze/io/safetensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>

#include "wordgaze/core/crc32.hpp"
#include "wordgaze/core/nesting.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/io/file.hpp"

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they lie in memory");

namespace wordgaze::io {
namespace {

using nlohmann::json;

constexpr std::string_view kMetadata = "__metadata__";
constexpr std::string_view kChecksum = "wordgaze.crc32";
constexpr std::string_view kNoChecksum = "00000000";  // in its place while the checksum is computed
constexpr std::size_t kLengthBytes = 8;
constexpr std::size_t kLargestHeader = 16 << 20;
constexpr std::size_t kMostNames = 2000;  // in one object of the header: the parser walks them

/// Names of the number types, in the order of Tensor::Values.
constexpr std::array<std::string_view, 4> kTypes{"F32", "F64", "I64", "U8"};

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string_view bytes_of(const Tensor& tensor) {
  return std::visit([](const auto& values) { return bytes_of(values); }, tensor.values);
}

/// Empty values of the type of that name.
std::optional<Tensor::Values> values_of_type(std::string_view type) {
  if (type == "F32") return std::vector<float>{};
  if (type == "F64") return std::vector<double>{};
  if (type == "I64") return std::vector<std::int64_t>{};
  if (type == "U8") return std::vector<std::uint8_t>{};
  return std::nullopt;
}

std::size_t number_size(const Tensor::Values& values) {
  return std::visit([](const auto& v) { return sizeof(v[0]); }, values);
}

/// Where the checksum's digits stand in a header; JSON escapes quotes, so no name can look like it.
std::size_t checksum_position(std::string_view header) {
  const std::string label = fmt::format("\"{}\":\"", kChecksum);
  const std::size_t found = header.find(label);
  const std::size_t digits = found + label.size();
  const bool whole =
      found != std::string_view::npos && digits + kNoChecksum.size() <= header.size();
  return whole ? digits : std::string_view::npos;
}

// --- writing -------------------------------------------------------------------------------------

/// Product of the shape, if it is one and fits.
std::optional<std::uint64_t> number_of_values(std::span<const std::int64_t> shape) {
  std::uint64_t product = 1;
  for (const std::int64_t extent : shape) {
    if (extent < 0 ||
        __builtin_mul_overflow(product, static_cast<std::uint64_t>(extent), &product)) {
      return std::nullopt;
    }
  }
  return product;
}

void check(const std::string& name, const Tensor& tensor) {
  require(name != kMetadata, "'{}' cannot be the name of a tensor", name);
  const std::size_t size = std::visit([](const auto& v) { return v.size(); }, tensor.values);
  require(number_of_values(tensor.shape) == size, "tensor {} is {} but has {} values", name,
          description(tensor), size);
}

std::string dump(const json& header) {
  try {
    return header.dump();
  } catch (const json::type_error&) {
    throw std::invalid_argument("names and metadata of a tensor file must be UTF-8");
  }
}

}  // namespace

void write_safetensors(const std::filesystem::path& path, const TensorMap& content) {
  using Entry = const std::pair<const std::string, Tensor>;
  std::vector<Entry*> entries;
  for (Entry& entry : content.tensors) {
    check(entry.first, entry.second);
    entries.push_back(&entry);
  }
  // Wide numbers first, so that each tensor is aligned in a file that is mapped to memory.
  std::ranges::stable_sort(entries, std::greater{},
                           [](Entry* entry) { return number_size(entry->second.values); });

  json header;
  std::size_t offset = 0;
  std::vector<std::string_view> parts(2);
  for (const auto* entry : entries) {
    const auto& [name, tensor] = *entry;
    const std::string_view bytes = bytes_of(tensor);
    header[name] = {{"dtype", kTypes[tensor.values.index()]},
                    {"shape", tensor.shape},
                    {"data_offsets", {offset, offset + bytes.size()}}};
    offset += bytes.size();
    parts.push_back(bytes);
  }
  require(!content.metadata.contains(kChecksum), "'{}' is reserved", kChecksum);
  header[kMetadata] = content.metadata;
  header[kMetadata][kChecksum] = kNoChecksum;

  std::string text = dump(header);
  text.resize((text.size() + 7) / 8 * 8, ' ');
  std::string length(kLengthBytes, '\0');
  const std::uint64_t size = text.size();
  std::memcpy(length.data(), &size, kLengthBytes);
  parts[0] = length;
  parts[1] = text;

  std::uint32_t checksum = 0;
  for (const std::string_view part : parts) checksum = crc32(part, checksum);
  text.replace(checksum_position(text), kNoChecksum.size(), fmt::format("{:08x}", checksum));
  write_file(path, parts);
}

// --- reading -------------------------------------------------------------------------------------

namespace {

template <class... Args>
void expect(bool ok, fmt::format_string<Args...> message, Args&&... args) {
  if (!ok) throw std::runtime_error(fmt::format(message, std::forward<Args>(args)...));
}

/// The header as JSON, in which no name occurs twice (the parser alone would keep the last one).
json parse_header(std::string_view text) {
  expect(json_nesting(text) <= 3, "its header is nested too deeply");
  std::vector<std::set<std::string>> names;  // of the objects that are open
  const auto watch = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end) names.pop_back();
    if (event == json::parse_event_t::key) {
      const auto name = parsed.get<std::string>();
      expect(names.back().insert(name).second, "its header has '{}' twice", shortened(name));
      expect(names.back().size() <= kMostNames, "its header has more than {} names", kMostNames);
    }
    return true;
  };
  try {
    json header = json::parse(text, watch);
    expect(header.is_object(), "its header is not a JSON object");
    return header;
  } catch (const json::exception& error) {
    throw std::runtime_error(
        fmt::format("its header is not JSON: {}", shortened(error.what(), 300)));
  }
}

struct Extent {
  std::string name;
  std::uint64_t begin, end;
};

std::vector<std::uint64_t> counts(const json& entry, const char* key, std::string_view name) {
  const auto found = entry.find(key);
  const auto is_count = [](const json& number) { return number.is_number_unsigned(); };
  expect(found != entry.end() && found->is_array() && std::ranges::all_of(*found, is_count),
         "tensor '{}' has no valid {}", shortened(name), key);
  return found->get<std::vector<std::uint64_t>>();
}

/// One tensor of the header with its numbers from the data.
std::pair<Tensor, Extent> read_tensor(const std::string& name, const json& entry,
                                      std::string_view data) {
  expect(entry.is_object() && entry.contains("dtype") && entry["dtype"].is_string(),
         "tensor '{}' has no valid dtype", shortened(name));
  const auto type = entry["dtype"].get<std::string>();
  auto values = values_of_type(type);
  expect(values.has_value(), "tensor '{}' has numbers of type '{}', expected F32, F64, I64 or U8",
         shortened(name), shortened(type));

  const auto shape = counts(entry, "shape", name);
  const auto offsets = counts(entry, "data_offsets", name);
  expect(offsets.size() == 2, "tensor '{}' has no valid data_offsets", shortened(name));
  const std::uint64_t begin = offsets[0], end = offsets[1];
  expect(begin <= end && end <= data.size(),
         "tensor '{}' is said to lie at bytes {} to {}, but there are {} (truncated?)",
         shortened(name), begin, end, data.size());

  Tensor tensor{{shape.begin(), shape.end()}, std::move(*values)};
  const auto count = number_of_values(tensor.shape);
  const std::size_t size = number_size(tensor.values);
  expect(count && *count <= data.size() / size && *count * size == end - begin,
         "tensor '{}' is {}, but has {} bytes", shortened(name), shortened(description(tensor)),
         end - begin);
  std::visit(
      [&](auto& v) {
        v.resize(*count);
        if (*count > 0) std::memcpy(v.data(), data.data() + begin, end - begin);
      },
      tensor.values);
  return {std::move(tensor), {name, begin, end}};
}

void expect_no_gaps(std::vector<Extent> extents, std::uint64_t size) {
  std::ranges::sort(extents, {}, [](const Extent& e) { return std::pair(e.begin, e.end); });
  std::uint64_t end = 0;
  for (const Extent& extent : extents) {
    expect(extent.begin == end, "tensor '{}' begins at byte {}, but the one before ends at {}",
           shortened(extent.name), extent.begin, end);
    end = extent.end;
  }
  expect(end == size, "there are {} bytes behind the last tensor", size - end);
}

/// `digits` is where the checksum stands in the file; it was computed with zeros in that place.
void expect_checksum(std::string_view file, std::size_t digits, std::string_view written) {
  std::uint32_t checksum = crc32(file.substr(0, digits));
  checksum = crc32(kNoChecksum, checksum);
  checksum = crc32(file.substr(digits + kNoChecksum.size()), checksum);
  expect(
      written == fmt::format("{:08x}", checksum),
      "its checksum is {:08x}, but it says {}: the file is corrupted (or another program rewrote "
      "it; then remove the metadata entry '{}')",
      checksum, shortened(written), kChecksum);
}

TensorMap parse(std::string_view file, bool& checked) {
  std::uint64_t length = 0;
  expect(file.size() >= kLengthBytes, "it has only {} bytes; not a safetensors file", file.size());
  std::memcpy(&length, file.data(), kLengthBytes);
  expect(length <= kLargestHeader && length <= file.size() - kLengthBytes,
         "it has {} bytes, but says that its header has {}; not a safetensors file, or truncated",
         file.size(), length);
  const std::string_view header = file.substr(kLengthBytes, length);
  const std::string_view data = file.substr(kLengthBytes + length);

  TensorMap content;
  std::vector<Extent> extents;
  const json entries = parse_header(header);
  for (const auto& [name, entry] : entries.items()) {
    if (name == kMetadata) {
      const auto is_text = [](const json& value) { return value.is_string(); };
      expect(entry.is_object() && std::ranges::all_of(entry, is_text),
             "its metadata is not a list of texts");
      for (const auto& [key, value] : entry.items()) content.metadata[key] = value;
    } else {
      auto [tensor, extent] = read_tensor(name, entry, data);
      content.tensors.emplace(name, std::move(tensor));
      extents.push_back(std::move(extent));
    }
  }
  expect_no_gaps(std::move(extents), data.size());
  const auto checksum = content.metadata.extract(std::string(kChecksum));
  checked = !checksum.empty();
  if (checked) {
    const std::size_t digits = checksum_position(header);
    expect(digits != std::string_view::npos, "its checksum is not written as it should be");
    expect_checksum(file, kLengthBytes + digits, checksum.mapped());
  }
  return content;
}

}  // namespace

TensorMap read_safetensors(const std::filesystem::path& path, bool* checked) {
  const std::string file = read_file(path);
  try {
    bool has_checksum = false;
    TensorMap content = parse(file, has_checksum);
    if (checked != nullptr) *checked = has_checksum;
    return content;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read '{}': {}", path.string(), error.what()));
  }
}

}  // namespace wordgaze::io
