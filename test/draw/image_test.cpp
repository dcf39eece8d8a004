#include "wordgaze/draw/image.hpp"

#include <gtest/gtest.h>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::draw {
namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = static_cast<std::uint8_t>(x * 7);
      image.pixel(x, y)[1] = static_cast<std::uint8_t>(y * 5);
      image.pixel(x, y)[2] = static_cast<std::uint8_t>(x * y);
    }
  }
  return image;
}

TEST(Image, PastesAPart) {
  Image image(4, 3);
  image.paste(gradient(2, 2), 1, 1);
  EXPECT_EQ(image.pixel(2, 2)[0], 7);
  EXPECT_EQ(image.pixel(2, 2)[1], 5);
  EXPECT_EQ(image.pixel(3, 2)[0], 0);
}

TEST(Image, WritesAPngOfItsSize) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", gradient(300, 2));
  const std::string file = io::read_file(folder / "a.png");
  EXPECT_TRUE(file.starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(file.substr(16, 8), std::string("\0\0\1\x2c\0\0\0\2", 8));  // width, height
  EXPECT_EQ(png(gradient(300, 2)), file);
}

TEST(Image, SaysThatThePngCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(
      message_of<std::runtime_error>([&] { write_png(folder / "no/a.png", gradient(9, 9)); }),
      "no/a.png': No such file or directory"));
  write_png(folder / "a.png", gradient(9, 9));
  const std::string before = io::read_file(folder / "a.png");
  EXPECT_THROW(
      {
        const SmallDisk disk(100);
        write_png(folder / "a.png", gradient(99, 99));
      },
      std::runtime_error);
  EXPECT_EQ(io::read_file(folder / "a.png"), before);
  EXPECT_THROW(png(gradient(100'000, 1)), std::runtime_error);
}

}  // namespace
}  // namespace wordgaze::draw
