#include "wordgaze/io/weights_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/config_file.hpp"
#include "wordgaze/io/file.hpp"
#include "wordgaze/io/safetensors.hpp"
#include "wordgaze/model/config.hpp"

/// Files of format 1 are read as what they were: settings that they lack take the values of then.
namespace wordgaze::io {
namespace {

model::Config config_of(const char* format, const char* toml) {
  TensorMap map;
  map.metadata["wordgaze.format"] = format;
  map.metadata["wordgaze.config"] = toml;
  return parse_section<model::Config>(configuration_text(map), "model", "test");
}

TEST(WeightsFile, OfFormat1HasThePapersGaze) {
  const auto c = config_of("1", "env = \"x\"\n\n[model]\nattention = true\n\n[ppo]\nlanes = 3\n");
  EXPECT_EQ(c.gaze, model::Gaze::sum);
  EXPECT_EQ(c.task_reader, model::Reader::sum);
  EXPECT_EQ(c.entropy_base, 49);
  EXPECT_EQ(c.sub_tasks, 4);
}

TEST(WeightsFile, OfFormat1KeepsWhatItSays) {
  const auto c = config_of(
      "1", "[model]\ntask_places = true\nclauses = 2  # as it was called\nentropy_base = 3.0\n");
  EXPECT_EQ(c.gaze, model::Gaze::sum);
  EXPECT_EQ(c.task_reader, model::Reader::places);
  EXPECT_EQ(c.entropy_base, 3);
  EXPECT_EQ(c.sub_tasks, 2);
}

TEST(WeightsFile, OfFormat1MayLackTheSection) {
  EXPECT_EQ(config_of("1", "frames = 3\n").gaze, model::Gaze::sum);
}

TEST(WeightsFile, OfTodayHasTodaysDefaults) {
  EXPECT_EQ(config_of("2", "[model]\nattention = true\n"), model::Config{});
}

TEST(WeightsFile, WithoutItsChecksumIsSaidToBeUnchecked) {
  const TemporaryFolder folder;
  const auto path = folder / "weights.safetensors";
  TensorMap map;
  map.metadata["wordgaze.format"] = kWeightsFormat;
  map.metadata["wordgaze.config"] = "";
  write_safetensors(path, map);
  testing::internal::CaptureStderr();
  read_weights_file(path);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  std::string file = read_file(path);
  file[file.find("wordgaze.crc32")] ^= 1;  // the name, not the sum
  write_file(path, file);
  testing::internal::CaptureStderr();
  read_weights_file(path);
  read_weights_file(path);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(said, "weights.safetensors' has no checksum (wordgaze.crc32)"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

}  // namespace
}  // namespace wordgaze::io
