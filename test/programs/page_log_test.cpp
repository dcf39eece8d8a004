#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "programs/shell.hpp"
#include "support/messages.hpp"

/// Pages made of LCM logs.
namespace wordgaze {
namespace {

#if WORDGAZE_WITH_LCM
const std::string kModel = WORDGAZE_SOURCE_DIR "/models/single-attention.safetensors ";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(PageOfALog, ShowsTheEpisodesOfEachRun) {
  Shell run;
  ASSERT_TRUE(succeeded(run("eval --episodes 5 --lcm-log a.lcmlog --checkpoint " + kModel)));
  const auto made = run("wordgaze page --log a.lcmlog --out a.html --episodes 3");
  ASSERT_TRUE(succeeded(made));
  EXPECT_TRUE(contains(made.out, "6 of 10 episodes"));  // sampled and greedy
  const std::string page = run.read("a.html");
  EXPECT_EQ(count(page, "\"run\":\"eval-1-sampled\""), 3u);
  EXPECT_EQ(count(page, "\"run\":\"eval-2-greedy\""), 3u);
  EXPECT_EQ(count(page, "\"success\":"), 6u);
}

TEST(PageOfALog, SaysWhatItLeftOut) {
  Shell run;
  ASSERT_TRUE(succeeded(run("eval --episodes 5 --greedy --lcm-log a.lcmlog --checkpoint " + kModel +
                            "&& truncate -s -30 a.lcmlog")));
  const auto made = run("wordgaze page --log a.lcmlog --out a.html");
  ASSERT_TRUE(succeeded(made));
  EXPECT_TRUE(contains(made.out, "bytes behind the last whole event"));
}

TEST(PageOfALog, RefusesWhatIsNoLogAndWritesNothing) {
  Shell run;
  run.write("text.lcmlog", "no log");
  EXPECT_TRUE(refused(run("wordgaze page --log text.lcmlog --out a.html"), "no event of LCM"));
  EXPECT_TRUE(refused(run("wordgaze page --log none.lcmlog --out a.html"), "none.lcmlog"));
  EXPECT_TRUE(refused(run("wordgaze page --log text.lcmlog --out text.lcmlog"), "--out"));
  EXPECT_TRUE(refused(run("wordgaze page --out a.html"), "--log"));
  EXPECT_FALSE(run.has("a.html"));
  EXPECT_EQ(run.read("text.lcmlog"), "no log");
}

TEST(PageOfALog, ThatLcmLoggerRecordedOfALiveRun) {
  Shell run;
  const std::string url =
      "udpm://239.255.76.72:" + std::to_string(20'000 + ::getpid() % 40'000) + "?ttl=0";
  const auto recorded =
      run("command -v lcm-logger || exit 77\nurl='" + url +
          "'\nlcm-logger -q --lcm-url=$url a.lcmlog & logger=$!\nsleep 1\n"
          "eval --episodes 3 --greedy --live --hz 200 --lcm-url $url --checkpoint " +
          kModel + "\nstatus=$?; sleep 1; kill -INT $logger; wait $logger; exit $status");
  if (recorded.status == 77) GTEST_SKIP() << "needs lcm-logger";
  if (recorded.err.find("ip route add") != std::string::npos) {
    GTEST_SKIP() << "needs a route for multicast";
  }
  ASSERT_TRUE(succeeded(recorded));
  const auto made = run("wordgaze page --log a.lcmlog --out a.html");
  ASSERT_TRUE(succeeded(made));
  EXPECT_TRUE(contains(made.out, "3 of 3 episodes"));
  EXPECT_EQ(count(run.read("a.html"), "\"success\":"), 3u);
}
#endif

}  // namespace
}  // namespace wordgaze
