#include "wordgaze/io/weights_file.hpp"

#include <array>
#include <cstdio>
#include <functional>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/io/safetensors.hpp"

namespace wordgaze::io {
namespace {

constexpr std::string_view kFirstFormat = "1";

/// A setting of [model] that format 1 did not have, or whose default was another.
struct Former {
  std::string_view key, value;
};
constexpr std::array kFormerSettings{Former{"gaze", "\"sum\""}, Former{"task_reader", "\"sum\""},
                                     Former{"entropy_base", "49"}, Former{"sub_tasks", "4"}};

std::string brought_up_to_date(const std::string& toml) {
  std::istringstream lines(toml);
  std::string model, others, section, line;
  std::set<std::string, std::less<>> said;
  while (std::getline(lines, line)) {
    if (line.starts_with('[')) section = line;
    const bool of_model = section == "[model]" && !line.starts_with('[');
    std::string key = of_model ? line.substr(0, line.find_first_of(" =")) : "";
    if (key == "clauses") key = "sub_tasks";
    if (key == "task_places") {  // has become one of the values of task_reader
      line = line.find("true") != line.npos ? "task_reader = \"places\"" : "task_reader = \"sum\"";
      key = "task_reader";
    }
    if (of_model) said.insert(key);
    (of_model ? model : others) += line + '\n';
  }
  for (const auto& [key, value] : kFormerSettings) {
    if (!said.contains(key)) model += std::string(key) + " = " + std::string(value) + '\n';
  }
  const std::string header = "[model]\n";
  const auto at = others.find(header);
  if (at == others.npos) return others + header + model;
  return others.insert(at + header.size(), model);
}

/// Once a file: a command may read it several times.
void say_unchecked(const std::filesystem::path& path) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> said;
  const std::scoped_lock lock(mutex);
  if (!said.insert(path).second) return;
  std::fprintf(stderr,
               "note: '%s' has no checksum (wordgaze.crc32), as if another program had written it: "
               "whether it is damaged is not checked\n",
               path.c_str());
}

}  // namespace

void fail_weights_file(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error("checkpoint '" + path.string() + "': " + what);
}

TensorMap read_weights_file(const std::filesystem::path& path) {
  bool checked = false;
  TensorMap map = read_safetensors(path, &checked);
  const auto format = map.metadata.find("wordgaze.format");
  if (format == map.metadata.end() || !map.metadata.contains("wordgaze.config")) {
    fail_weights_file(
        path,
        "a safetensors file, but not a checkpoint of wordgaze train (its metadata has "
        "no wordgaze.format)");
  }
  if (format->second != kWeightsFormat && format->second != kFirstFormat) {
    fail_weights_file(path, "format " + shortened(format->second) +
                                ", this program reads the formats " + std::string(kFirstFormat) +
                                " and " + std::string(kWeightsFormat));
  }
  if (!checked) say_unchecked(path);
  return map;
}

std::string configuration_text(const TensorMap& map) {
  const std::string& text = map.text("wordgaze.config");
  return map.text("wordgaze.format") == kFirstFormat ? brought_up_to_date(text) : text;
}

}  // namespace wordgaze::io
