#include <gtest/gtest.h>

#include "programs/shell.hpp"
#include "support/messages.hpp"

namespace wordgaze {
namespace {

const std::string kPlay = "wordgaze play --terminal --checkpoint " WORDGAZE_SOURCE_DIR
                          "/models/single-attention.safetensors ";

TEST(Play, TheAgentDoesItsMissionInTheTerminal) {
  Shell run;
  const auto played = run("printf gq | " + kPlay);
  ASSERT_TRUE(succeeded(played));
  EXPECT_TRUE(contains(played.out, "the agent would"));
  EXPECT_TRUE(contains(played.out, "looks: "));
  EXPECT_TRUE(contains(played.out, "done after "));
}

TEST(Play, APersonActs) {
  Shell run;
  // Two turns to the left: the agent looks the other way. An arrow is three bytes.
  const auto played = run("printf '\\033[D\\033[Dq' | " + kPlay);
  ASSERT_TRUE(succeeded(played));
  EXPECT_TRUE(contains(played.out, "step 0,"));
  EXPECT_TRUE(contains(played.out, "step 2,"));
  const auto count = [&](const std::string& letter) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = played.out.find(letter, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(count("> ") + count("< ") + count("v ") + count("^ "), 3u);
}

TEST(Play, AMissionCanBeTyped) {
  Shell run;
  const auto played = run("printf 'mgo to the moon\\nmgo to a ball\\ngq' | " + kPlay + "--seed 5");
  ASSERT_TRUE(succeeded(played));
  EXPECT_TRUE(contains(played.out, "moon"));  // is not of the language, and that is said
  EXPECT_TRUE(contains(played.out, "done after "));
}

TEST(Play, EndsWithItsInput) {
  Shell run;
  EXPECT_TRUE(succeeded(run(kPlay)));
  EXPECT_TRUE(refused(run(kPlay + "--env Nowhere-v0"), "Nowhere-v0"));
  EXPECT_TRUE(refused(run("wordgaze play --terminal"), "--checkpoint"));
}

}  // namespace
}  // namespace wordgaze
