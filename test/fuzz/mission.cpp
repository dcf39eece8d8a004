// Missions: what is read in words is written in words that read the same.
#include "fuzz.hpp"
#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/babyai/sentence.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wordgaze;
  const auto text = fuzz::text_of(data, size);
  fuzz::refused([&] { babyai::parse_mission(text); });
  fuzz::refused([&] {
    const auto sentence = babyai::sentence_of(text);
    fuzz::check(babyai::sentence_of(babyai::text(sentence)) == sentence);
  });
  return 0;
}
