// Tensor files, whatever their bytes. What is read is written as a file that reads back the same.
#include "fuzz.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/safetensors.hpp"
#include "wordgaze/io/weights_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  static const auto path = fuzz::scratch_file();
  io::write_file(path, fuzz::text_of(data, size));
  fuzz::refused([&] { io::configuration_text(io::read_weights_file(path)); });
  fuzz::refused([&] {
    const auto content = io::read_safetensors(path);
    io::write_safetensors(path, content);
    const auto again = io::read_safetensors(path);
    fuzz::check(again.tensors.size() == content.tensors.size());
  });
  std::filesystem::remove(path);
  return 0;
}
