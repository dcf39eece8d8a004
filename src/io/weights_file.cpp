#include "wordgaze/io/weights_file.hpp"

#include <stdexcept>

#include "wordgaze/io/safetensors.hpp"

namespace wordgaze::io {

void fail_weights_file(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error("checkpoint '" + path.string() + "': " + what);
}

TensorMap read_weights_file(const std::filesystem::path& path) {
  TensorMap map = read_safetensors(path);
  const auto format = map.metadata.find("wordgaze.format");
  if (format == map.metadata.end() || !map.metadata.contains("wordgaze.config")) {
    fail_weights_file(
        path,
        "a safetensors file, but not a checkpoint of wordgaze train (its metadata has "
        "no wordgaze.format)");
  }
  if (format->second != kWeightsFormat) {
    fail_weights_file(path, "format " + format->second + ", this program reads format " +
                                std::string(kWeightsFormat));
  }
  return map;
}

const std::string& configuration_text(const TensorMap& map) { return map.text("wordgaze.config"); }

}  // namespace wordgaze::io
