#include "wordgaze/io/config_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace wordgaze::io {
namespace test {

enum class Decay { none, linear };
constexpr std::array<std::string_view, 2> names(Decay) { return {"none", "linear"}; }

struct Clip {
  float ratio = 0.2f;
  double norm = 0.5;
  static constexpr auto settings() {
    return std::tuple{Setting{"ratio", &Clip::ratio, "of the ratio", 0, 1},
                      Setting{"norm", &Clip::norm, "of the gradient", 0,
                              std::numeric_limits<double>::infinity()}};
  }
  bool operator==(const Clip&) const = default;
};

struct Training {
  Clip clip{};
  int steps = 20;
  Decay decay = Decay::linear;
  static constexpr auto settings() {
    return std::tuple{Setting{"clip", &Training::clip, "limits of an update"},
                      Setting{"steps", &Training::steps, "steps of a rollout", 1, 4096},
                      Setting{"decay", &Training::decay, "of the learning rate"}};
  }
  bool operator==(const Training&) const = default;
};

struct Config {
  std::string env = "Wordgaze-One-N8-K4-v0";
  bool attention = true;
  std::uint64_t seed = 1;
  std::int64_t frames = 2'000'000;
  Training training{};
  static constexpr auto settings() {
    return std::tuple{Setting{"env", &Config::env, "environment id"},
                      Setting{"attention", &Config::attention, "look at words"},
                      Setting{"training", &Config::training, "how to learn"},
                      Setting{"seed", &Config::seed, "of everything"},
                      Setting{"frames", &Config::frames, "in all", 1, 1e12}};
  }
  bool operator==(const Config&) const = default;
};

}  // namespace test

namespace {

using test::Config;

std::string refusal(std::string_view toml) {
  return message_of<std::invalid_argument>([&] { parse_config<Config>(toml, "a.toml"); });
}

std::string refusal_to_set(std::string_view assignment) {
  Config config;
  const std::string message =
      message_of<std::invalid_argument>([&] { set_option(config, assignment); });
  EXPECT_EQ(config, Config{});
  return message;
}

TEST(ConfigFile, ReadsEveryKindOfSettingAndNestedSections) {
  const auto config = parse_config<Config>(R"(
env = "BabyAI-GoToObj-v0"
attention = false
seed = 7
frames = 1_000
[training]
steps = 40
decay = "none"
[training.clip]
ratio = 0.1
norm = 2
)",
                                           "a.toml");
  const Config expected{
      .env = "BabyAI-GoToObj-v0",
      .attention = false,
      .seed = 7,
      .frames = 1000,
      .training = {.clip = {.ratio = 0.1f, .norm = 2}, .steps = 40, .decay = test::Decay::none}};
  EXPECT_EQ(config, expected);
}

TEST(ConfigFile, KeepsTheGivenDefaultOfWhatIsNotWritten) {
  const auto config = parse_config("training.steps = 5", "a.toml", Config{.seed = 9});
  EXPECT_EQ(config.seed, 9u);
  EXPECT_EQ(config.training.steps, 5);
  EXPECT_EQ(config.training.clip, test::Clip{});
}

TEST(ConfigFile, WritesWhatItReadsBack) {
  Config config;
  config.env = "quote \" backslash \\ newline \n end";
  config.frames = std::numeric_limits<std::int64_t>::max() / 10'000'000;
  config.training.clip = {.ratio = 1.0f / 3, .norm = 1e-300};
  EXPECT_EQ(parse_config<Config>(to_toml(config), "written"), config);
}

TEST(ConfigFile, WritesEachDescriptionAndRangeAsAComment) {
  EXPECT_EQ(to_toml(test::Training{}),
            "# steps of a rollout; [1, 4096]\n"
            "steps = 20\n"
            "# of the learning rate; none, linear\n"
            "decay = \"linear\"\n"
            "\n"
            "# limits of an update\n"
            "[clip]\n"
            "# of the ratio; [0, 1]\n"
            "ratio = 0.2\n"
            "# of the gradient; [0, inf]\n"
            "norm = 0.5\n");
}

TEST(ConfigFile, NamesLineKeyAndNearestKeyOfAnUnknownOne) {
  EXPECT_EQ(refusal("seed = 1\n[training]\nstepz = 2"),
            "a.toml:3: unknown key 'training.stepz'; did you mean 'training.steps'?");
  EXPECT_TRUE(contains(refusal("[trainign]\nsteps = 2"), "did you mean 'training'?"));
}

TEST(ConfigFile, FindsTheNearestKeyInAnotherSection) {
  EXPECT_TRUE(contains(refusal("ratio = 0.1"), "did you mean 'training.clip.ratio'?"));
}

TEST(ConfigFile, SaysWhichTypeWasExpectedAndWhichCame) {
  EXPECT_EQ(refusal("\nframes = \"many\""),
            "a.toml:2: frames: expected an integer in the range [1, 1000000000000]; came the text "
            "\"many\"");
  EXPECT_TRUE(contains(refusal("frames = 1.5"), "expected an integer"));
  EXPECT_TRUE(contains(refusal("frames = true"), "came true"));
  EXPECT_TRUE(contains(refusal("attention = 1"), "expected true or false; came the integer 1"));
  EXPECT_TRUE(contains(refusal("env = 3"), "expected text; came the integer 3"));
  EXPECT_TRUE(contains(refusal("seed = [1, 2]"), "expected an integer; came a list"));
  EXPECT_TRUE(contains(refusal("training = 3"), "training: expected a section"));
  EXPECT_TRUE(contains(refusal("[seed]\nx = 3"), "seed: expected an integer; came a section"));
  EXPECT_TRUE(contains(refusal("training.clip.ratio = \"x\""), "expected a number"));
}

TEST(ConfigFile, RefusesValuesOutOfRange) {
  EXPECT_EQ(
      refusal("training.steps = 0"),
      "a.toml:1: training.steps: expected an integer in the range [1, 4096]; came the integer 0");
  EXPECT_TRUE(
      contains(refusal("training.steps = 4097"), "in the range [1, 4096]; came the integer 4097"));
  EXPECT_TRUE(contains(refusal("training.clip.ratio = 1.01"), "[0, 1]"));
  EXPECT_TRUE(contains(refusal("training.clip.norm = -1"), "[0, inf]"));
  EXPECT_TRUE(contains(refusal("training.clip.norm = nan"), "came the number nan"));
  EXPECT_TRUE(contains(refusal("training.clip.norm = inf"), "came the number inf"));
  EXPECT_TRUE(contains(refusal("seed = -1"), "came the integer -1"));
  EXPECT_NO_THROW(parse_config<Config>("training.steps = 4096", "a.toml"));
}

TEST(ConfigFile, ListsTheAllowedNames) {
  EXPECT_EQ(refusal("training.decay = \"cosine\""),
            "a.toml:1: training.decay: expected one of none, linear; came the text \"cosine\"");
}

TEST(ConfigFile, SaysWhereTomlIsMalformed) {
  EXPECT_TRUE(contains(refusal("seed = 1\nframes = = 2"), "a.toml:2: not valid TOML"));
  EXPECT_TRUE(contains(refusal("seed = 1\nseed = 2"), "not valid TOML"));
}

TEST(ConfigFile, ReadsFilesAndNamesThemInErrors) {
  const TemporaryFolder folder;
  const auto path = folder / "config.toml";
  write_file(path, "training.steps = 7");
  EXPECT_EQ(read_config<Config>(path).training.steps, 7);
  write_file(path, "steps = 7");
  EXPECT_TRUE(contains(message_of<std::invalid_argument>([&] { read_config<Config>(path); }),
                       path.string() + ":1: "));
}

TEST(ConfigFile, SaysWhyAFileCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { read_config<Config>(folder / "no.toml"); }),
               "no.toml': No such file or directory"));
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { read_config<Config>(folder.path()); }),
                       "Is a directory"));
}

TEST(SetOption, TakesTomlValuesAndBareText) {
  Config config;
  set_option(config, "training.steps=64");
  set_option(config, "training.clip.ratio=0.25");
  set_option(config, "training.clip.norm=3");
  set_option(config, "training.decay=none");
  set_option(config, "attention=false");
  EXPECT_EQ(config.training, (test::Training{{.ratio = 0.25f, .norm = 3}, 64, test::Decay::none}));
  EXPECT_FALSE(config.attention);
}

TEST(SetOption, TakesTextAsItStands) {
  Config config;
  const auto env_after = [&](std::string_view assignment) {
    set_option(config, assignment);
    return config.env;
  };
  EXPECT_EQ(env_after("env=BabyAI-GoToObj-v0"), "BabyAI-GoToObj-v0");
  EXPECT_EQ(env_after("env=\"in quotes\""), "in quotes");
  EXPECT_EQ(env_after("env=42"), "42");
  EXPECT_EQ(env_after("env=a=b"), "a=b");
  EXPECT_EQ(env_after("env="), "");
  EXPECT_EQ(env_after("env=1\nseed = 3"), "1\nseed = 3");
}

TEST(SetOption, RefusesWhatAFileWouldRefuseAndChangesNothing) {
  EXPECT_EQ(refusal_to_set("training.step=3"),
            "--set training.step=3: unknown key 'training.step'; did you mean 'training.steps'?");
  EXPECT_TRUE(contains(refusal_to_set("training.steps=0"), "in the range [1, 4096]"));
  EXPECT_TRUE(contains(refusal_to_set("training.steps=many"), "came the text \"many\""));
  EXPECT_TRUE(contains(refusal_to_set("training.decay=cosine"), "none, linear"));
  EXPECT_TRUE(contains(refusal_to_set("training=3"), "is a section"));
  EXPECT_TRUE(contains(refusal_to_set("=3"), "expected section.key=value"));
}

TEST(Differences, ListsSettingsThatDisagree) {
  Config other;
  other.training.clip.ratio = 0.3f;
  other.attention = false;
  EXPECT_TRUE(differences(Config{}, Config{}).empty());
  const std::vector<std::string> expected{
      "attention: true in the first, false in the second",
      "training.clip.ratio: 0.2 in the first, 0.3 in the second"};
  EXPECT_EQ(differences(Config{}, other), expected);
}

/// A setting that was called something else.
struct Renamed {
  int sub_tasks = 4;
  static constexpr auto settings() {
    return std::tuple{Setting{"sub_tasks", &Renamed::sub_tasks, "of a mission", 1, 8, "clauses"}};
  }
};
struct WithRenamed {
  Renamed model{};
  int other = 0;
  static constexpr auto settings() {
    return std::tuple{Setting{"other", &WithRenamed::other, "other"},
                      Setting{"model", &WithRenamed::model, "the network"}};
  }
};

TEST(RenamedSetting, IsReadByItsFormerNameAndWrittenByItsOwn) {
  auto config = parse_config<WithRenamed>("[model]\nclauses = 7\n", "old.toml");
  EXPECT_EQ(config.model.sub_tasks, 7);
  set_option(config, "model.clauses=3");
  EXPECT_EQ(config.model.sub_tasks, 3);
  EXPECT_TRUE(contains(to_toml(config), "sub_tasks = 3"));
  EXPECT_FALSE(contains(to_toml(config), "clauses"));
  EXPECT_THROW(set_option(config, "model.clauses=9"), std::invalid_argument);
}

TEST(Section, IsReadWithoutTheOthers) {
  const std::string text = "foreign = true\n[model]\nsub_tasks = 2\n[ppo]\nclip = 0.1\n";
  EXPECT_EQ(parse_section<Renamed>(text, "model", "file.toml").sub_tasks, 2);
  EXPECT_EQ(parse_section<Renamed>("[ppo]\nclip = 1\n", "model", "file.toml").sub_tasks, 4);
  EXPECT_THROW(parse_section<Renamed>("[model]\nsub_task = 2\n", "model", "file.toml"),
               std::invalid_argument);
}

TEST(Reference, ListsEachSettingOfEachSection) {
  const std::string text = to_markdown<Config>();
  EXPECT_TRUE(contains(text, "| `attention` | `true` |  | look at words |\n"));
  EXPECT_TRUE(contains(text, "### training.clip\n\nlimits of an update\n\n| key |"));
  EXPECT_TRUE(contains(text, "| `training.steps` | `20` | [1, 4096] | steps of a rollout |\n"));
}

TEST(ConfigFile, AListOfTextsIsATextOfLines) {
  EXPECT_EQ(parse_config<Config>("env = [\"a\", \"b c\"]", "a.toml").env, "a\nb c");
  EXPECT_EQ(parse_config<Config>("env = []", "a.toml").env, "");
  EXPECT_TRUE(contains(refusal("env = [\"a\", 1]"), "env: expected text; came a list"));
  EXPECT_TRUE(contains(refusal("frames = [\"1\"]"), "frames: expected an integer"));
}

TEST(ConfigFile, KeepsTextsOfManyLines) {
  Config config;
  config.env = "a \"map\"\n#..#\n\t\\";
  EXPECT_EQ(parse_config<Config>(to_toml(config), "a.toml"), config);
  EXPECT_TRUE(contains(to_toml(config), "\\n#..#\\n"));
}

TEST(ConfigFile, CountsNestingOutsideOfTextsAndComments) {
  const std::string dots(5000, '.');
  EXPECT_EQ(parse_config<Config>("env = \"" + dots + "\" # " + dots, "a.toml").env, dots);
  EXPECT_EQ(parse_config<Config>("env = \"\"\"\n" + dots + "\n\"\"\"", "a.toml").env, dots + "\n");
}

TEST(ConfigFile, FindsOneTextWhateverElseThereIs) {
  EXPECT_EQ(text_of("level", "other = 1\nlevel = \"x\"\n[s]\nlevel = \"y\"", "a.toml"), "x");
  EXPECT_EQ(text_of("level", "[s]\nlevel = \"y\"", "a.toml"), "");
  EXPECT_EQ(text_of("level", "level = 3", "a.toml"), "");
}

TEST(ConfigFile, KnowsASettingByItsLastName) {
  EXPECT_EQ(key_named<Config>("steps"), "training.steps");
  EXPECT_EQ(key_named<Config>("env"), "env");
  EXPECT_EQ(key_named<Config>("clip"), "");  // a section
  EXPECT_EQ(key_named<Config>("nothing"), "");
}

TEST(SetOption, TakesWholeNumbersWithAnExponent) {
  Config config;
  set_option(config, "frames=4e6");
  EXPECT_EQ(config.frames, 4'000'000);
  EXPECT_TRUE(contains(refusal_to_set("frames=1.5e0"), "frames: expected an integer"));
  EXPECT_TRUE(contains(refusal_to_set("frames=1e13"), "frames: expected an integer"));
}

TEST(HostileConfiguration, IsRefusedBeforeItIsParsed) {
  const auto refusal = [](const std::string& toml) {
    return message_of<std::invalid_argument>([&] { parse_config<Config>(toml, "bad.toml"); });
  };
  const auto repeated = [](std::string_view part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  for (const std::string& toml :
       {"[a" + repeated(".a", 50'000) + "]", "a" + repeated(".a", 50'000) + " = 1",
        "a = " + repeated("[", 50'000), "a = " + repeated("{a = ", 50'000),
        "a" + repeated(" . \"a\"", 50'000) + " = 1", repeated("a = [{a.a.a.a = [{\n", 20'000)}) {
    EXPECT_TRUE(contains(refusal(toml), "bad.toml: more than 2000 dots and opening brackets"));
  }
  // What is let through is no deeper than the stack.
  EXPECT_TRUE(contains(refusal("[a" + repeated(".a", 1'990) + "]"), "unknown key 'a'"));
  EXPECT_TRUE(contains(refusal("a = " + repeated("[", 1'990)), "not valid TOML"));
  EXPECT_TRUE(contains(refusal(repeated("# long\n", 200'000)), "bad.toml: 1400000 bytes"));
  EXPECT_LT(refusal(std::string(1'000'000, 'k') + " = 1").size(), 1000u);
  EXPECT_LT(refusal("attention = \"" + std::string(1'000'000, 'v') + '"').size(), 1000u);
}

TEST(HostileConfiguration, IsRefusedWhereTheParserAsserts) {
  for (const char* toml :
       {"[= x", "[[= x", "[.a]", "[,]", "[[ =", "a = 1\n  [= x", "\xef\xbb\xbf[="}) {
    EXPECT_TRUE(
        contains(message_of<std::invalid_argument>([&] { parse_config<Config>(toml, "bad.toml"); }),
                 "bad.toml"))
        << toml;
  }
}

TEST(HostileConfiguration, HasLettersBeyondAsciiInQuotesAndCommentsAlone) {
  const auto refusal = [](const char* toml) {
    return message_of<std::invalid_argument>([&] { parse_config<Config>(toml, "bad.toml"); });
  };
  for (const char* toml :
       {"a = 0\u020c1", "\u00e9 = 1", "# \u00e9\n\n[\u3000]", "a = 'x'\u00a0",
        "a = \"\"\"\u00e9\"\"\"\"\"\n\u00e9 = 1", "a = \"\\\"\u00e9\"\u2000\n"}) {
    EXPECT_TRUE(contains(refusal(toml), "a letter beyond ASCII outside quotes")) << toml;
  }
  EXPECT_TRUE(contains(refusal("# 1\n'''\n'''=1\nb\u00e9"), "bad.toml:4"));
  // Where they may stand they are left to the parser.
  EXPECT_NO_THROW(parse_config<Config>("\xef\xbb\xbf# \u00e9 'a \"\n", "good.toml"));
  EXPECT_TRUE(contains(refusal("'\u00e9' = \"\"\"\n\u00e9\"\"\""), "unknown key"));
}

TEST(HostileAssignment, IsRefused) {
  Config config;
  const auto refusal = [&](const std::string& assignment) {
    return message_of<std::invalid_argument>([&] { set_option(config, assignment); });
  };
  EXPECT_TRUE(contains(refusal("training.steps=" + std::string(50'000, '[')), "dots and opening"));
  EXPECT_TRUE(contains(refusal("training.steps=" + std::string(2'000'000, '7')), "bytes"));
  EXPECT_LT(refusal(std::string(100'000, 'k') + "=1").size(), 1000u);
  EXPECT_LT(refusal("training.steps=" + std::string(100'000, '7')).size(), 1000u);
  EXPECT_TRUE(contains(refusal("training.steps=[= x"), "came the text"));
  EXPECT_TRUE(contains(refusal("training.steps=18446744073709551616"), "came the text"));
  EXPECT_TRUE(contains(refusal("training.steps=0\u020c1"), "came the text"));
}

TEST(Assignment, WithoutAValueHintsAtTheValue) {
  Config config;
  const auto refusal = [&](const std::string& assignment) {
    return message_of<std::invalid_argument>([&] { set_option(config, assignment); });
  };
  EXPECT_EQ(refusal("training.steps"),
            "--set training.steps: without a value; expected an integer in the range [1, 4096], as "
            "in --set training.steps=20");
  EXPECT_TRUE(contains(refusal("training.step"), "did you mean 'training.steps'?"));
  EXPECT_TRUE(contains(refusal("training"), "training is a section"));
}

}  // namespace
}  // namespace wordgaze::io
