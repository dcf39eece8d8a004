#include "wordgaze/io/csv_log.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>

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

TEST_F(CsvLogFile, StartsAnewOverItsOwnFileAndOverAnEmptyOne) {
  for (const char* content : {"", "frames,loss\n50,1\n"}) {
    write_file(path_, content);
    const CsvLog log(path_, columns_);
    EXPECT_EQ(read_file(path_), "frames,loss\n");
  }
}

TEST_F(CsvLogFile, LeavesAForeignFileAlone) {
  for (const char* content : {"something else", "frames,loss,more\n1,2,3\n", "\n", "frames"}) {
    write_file(path_, content);
    EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { CsvLog(path_, columns_); }),
                         "metrics.csv': a file of that name is there, and its header is '"));
    EXPECT_EQ(read_file(path_), content);
  }
}

TEST_F(CsvLogFile, SaysWhichRowsAreMissingOnResume) {
  const auto gap = [&](const std::string& rows) {
    write_file(path_, "frames,loss\n" + rows);
    return CsvLog::resume(path_, columns_, "frames", 150).gap();
  };
  EXPECT_EQ(gap("50,1\n100,2\n150,3\n"), "");
  EXPECT_EQ(gap("50,1\n100,2\n150,3\n200,4\n"), "");
  EXPECT_EQ(gap("50,1\n150,3\n"), "rows between frames 50 and 150 are missing");
  EXPECT_EQ(gap("100,2\n150,3\n"), "rows between frames 0 and 100 are missing");
  EXPECT_EQ(gap("50,1\n100,2\n"), "rows between frames 100 and 150 are missing");
  EXPECT_EQ(gap("50,1\n100,2\n15"), "rows between frames 100 and 150 are missing");
  EXPECT_EQ(gap(std::string("50,1\n100,2\n\0\0\0\0", 15)),
            "rows between frames 100 and 150 are missing");
  EXPECT_EQ(gap("50,1\n50,1\n100,2\n150,3\n"), "the rows are not in the order of frames");
  EXPECT_EQ(gap(""), "there are no rows of frames up to 150");
  std::filesystem::remove(path_);
  EXPECT_EQ(CsvLog::resume(path_, columns_, "frames", 150).gap(),
            "the file is not there: there are no rows of frames up to 150");
  std::filesystem::remove(path_);
  EXPECT_EQ(CsvLog::resume(path_, columns_, "frames", 0).gap(), "");
}

TEST_F(CsvLogFile, KnowsTheLastRowItKept) {
  write_file(path_, "frames,loss\n50,1\n100,2.5\n150,3\n");
  EXPECT_EQ(CsvLog::resume(path_, columns_, "frames", 100).last("loss"), 2.5);
  EXPECT_EQ(CsvLog(path_, columns_).last("loss"), 0);
  EXPECT_THROW(CsvLog(path_, columns_).last("gain"), std::invalid_argument);
}

TEST_F(CsvLogFile, ReachesTheDisk) {
  CsvLog log(path_, columns_);
  append(log, 100, 0.5);
  EXPECT_NO_THROW(log.sync());
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
