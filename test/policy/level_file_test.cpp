#include "wordgaze/policy/level_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/policy/environment.hpp"

namespace wordgaze::policy {
namespace {

TEST(LevelFile, HasTheNameOfItsFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "mine.toml";
  std::ofstream(path) << "objects = [\"2 balls\", \"key\"]\nmissions = \"go to {}\"\n";
  EXPECT_EQ(read_level_file(path).objects, "2 balls\nkey");
  EXPECT_EQ(load_level(path).id, "Own-mine-v0");
  std::ofstream(path) << "missions = \"go to {}\"\n";
  EXPECT_TRUE(
      contains(message_of<std::invalid_argument>([&] { load_level(path); }), "mine.toml: "));
  EXPECT_THROW(load_level(folder.path() / "none.toml"), std::runtime_error);
}

TEST(LevelFile, AConfigurationMeansItsTextOrItsId) {
  const std::string text = "id = \"Own-A-v0\"\nobjects = \"goal\"\n";
  EXPECT_EQ(level_of("Own-A-v0", text).id, "Own-A-v0");
  EXPECT_EQ(level_of("BabyAI-GoToLocal-v0", "").id, "BabyAI-GoToLocal-v0");
  EXPECT_THROW(level_of("BabyAI-GoToLocal-v0", text), std::invalid_argument);
  EXPECT_THROW(level_of("Own-A-v0", ""), std::invalid_argument);
}

TEST(LevelFile, TheAlphabetHoldsWhatALevelShows) {
  const auto size = [](const babyai::LevelText& text) {
    return alphabet_of(babyai::level_of(text)).size();
  };
  const int small = model::CellAlphabet::one_room().size(),
            all = model::CellAlphabet::everything().size();
  EXPECT_EQ(size({.id = "A", .map = "AK#", .missions = "go to {}"}), small);
  EXPECT_EQ(size({.id = "A", .map = "AD.", .missions = "go to {}"}), all);
  EXPECT_EQ(size({.id = "A", .map = "AKL", .missions = "go to {}"}), all);
  EXPECT_EQ(size({.id = "A", .map = "AK.", .objects = "goal", .missions = "go to {}"}), all);
  EXPECT_EQ(size({.id = "A", .map = "AKf", .legend = "f = floor", .missions = "go to {}"}), all);
  EXPECT_EQ(size({.id = "A", .columns = 2, .objects = "key", .missions = "go to {}"}), all);
}

}  // namespace
}  // namespace wordgaze::policy
