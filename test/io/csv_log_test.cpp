#include "wordgaze/io/csv_log.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

class CsvLogFile : public ::testing::Test {
 protected:
  void append(CsvLog& log, double frames, double loss) { log.append(std::array{frames, loss}); }
  std::string refusal_to_resume() {
    const std::string before = read_file(path_);
    const std::string message =
        message_of<std::runtime_error>([&] { CsvLog::resume(path_, columns_, "frames", 100); });
    EXPECT_EQ(read_file(path_), before);
    return message;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "metrics.csv";
  const std::vector<std::string> columns_{"frames", "loss"};
};

TEST_F(CsvLogFile, HasTheHeaderOnceAndEachRowAtOnce) {
  CsvLog log(path_, columns_);
  EXPECT_EQ(read_file(path_), "frames,loss\n");
  append(log, 100, 0.5);
  append(log, 2'000'000'000, -1e-9);
  EXPECT_EQ(read_file(path_), "frames,loss\n100,0.5\n2000000000,-1e-09\n");
}

TEST_F(CsvLogFile, WritesFloatsWithoutTheirRoundingErrorAndNaNAsNaN) {
  CsvLog log(path_, columns_);
  append(log, 0.1f, std::numeric_limits<double>::quiet_NaN());
  append(log, 1.0 / 3, std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_file(path_), "frames,loss\n0.1,nan\n0.3333333,inf\n");
}

TEST_F(CsvLogFile, StartsAnew) {
  write_file(path_, "something else");
  const CsvLog log(path_, columns_);
  EXPECT_EQ(read_file(path_), "frames,loss\n");
}

TEST_F(CsvLogFile, ResumesBehindTheCheckpoint) {
  write_file(path_, "frames,loss\n50,1\n100,nan\n150,3\n");
  CsvLog log = CsvLog::resume(path_, columns_, "frames", 100);
  append(log, 160, 4);
  EXPECT_EQ(read_file(path_), "frames,loss\n50,1\n100,nan\n160,4\n");
}

TEST_F(CsvLogFile, DropsAnUnfinishedRowOnResume) {
  write_file(path_, "frames,loss\n50,1\n60");
  CsvLog log = CsvLog::resume(path_, columns_, "frames", 100);
  append(log, 70, 2);
  EXPECT_EQ(read_file(path_), "frames,loss\n50,1\n70,2\n");
}

TEST_F(CsvLogFile, StartsAFileThatIsNotThereOnResume) {
  CsvLog log = CsvLog::resume(path_, columns_, "frames", 100);
  append(log, 110, 1);
  EXPECT_EQ(read_file(path_), "frames,loss\n110,1\n");
}

TEST_F(CsvLogFile, RefusesToResumeAFileThatIsNotItsOwn) {
  write_file(path_, "frames,return\n50,1\n");
  EXPECT_TRUE(contains(refusal_to_resume(),
                       "metrics.csv': its header is 'frames,return', expected 'frames,loss'"));
  write_file(path_, "");
  EXPECT_TRUE(contains(refusal_to_resume(), "its header is ''"));
  write_file(path_, "frames,loss\n50\n");
  EXPECT_TRUE(contains(refusal_to_resume(), "expected 2 values in the row '50'"));
  write_file(path_, "frames,loss\nmany,1\n");
  EXPECT_TRUE(contains(refusal_to_resume(), "expected a number, came 'many'"));
  EXPECT_THROW(CsvLog::resume(path_, columns_, "steps", 100), std::invalid_argument);
}

TEST_F(CsvLogFile, RefusesARowOfAnotherLength) {
  CsvLog log(path_, columns_);
  EXPECT_THROW(log.append(std::array{1.0}), std::invalid_argument);
  EXPECT_EQ(read_file(path_), "frames,loss\n");
}

TEST_F(CsvLogFile, SaysThatTheDiskIsFull) {
  CsvLog log(path_, columns_);
  const std::string message = message_of<std::runtime_error>([&] {
    const SmallDisk disk(20);
    for (int row = 0; row < 10; ++row) append(log, row, row);
  });
  EXPECT_TRUE(contains(message, "metrics.csv': File too large"));
  EXPECT_TRUE(
      contains(message_of<std::runtime_error>([&] { CsvLog(folder_ / "no/m.csv", columns_); }),
               "No such file or directory"));
}

}  // namespace
}  // namespace wordgaze::io
