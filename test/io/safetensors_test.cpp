#include "wordgaze/io/safetensors.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/messages.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"
#include "wordgaze/io/file.hpp"

namespace wordgaze::io {
namespace {

TensorMap example() {
  TensorMap map;
  map.tensors["bytes"] = {{3}, std::vector<std::uint8_t>{0, 127, 255}};
  map.tensors["memory.hidden_weight"] = {{2, 3}, std::vector<float>{1, -2, 3.5f, 0, 1e-30f, 1e30f}};
  map.tensors["moment"] = {{2}, std::vector<double>{0.1, std::numeric_limits<double>::infinity()}};
  map.tensors["frames"] = {{}, std::vector<std::int64_t>{-1}};
  map.tensors["nobody"] = {{0, 4}, std::vector<float>{}};
  map.metadata["config"] = "seed = 1\n\"quoted\" \\ ü";
  return map;
}

/// A file with this header and data, of the layout but without a checksum.
std::string file_of(std::string header, std::string_view data) {
  std::string file(8, '\0');
  const std::uint64_t size = header.size();
  std::memcpy(file.data(), &size, 8);
  return file + header + std::string(data);
}

class Safetensors : public ::testing::Test {
 protected:
  void put(std::string_view file) { std::ofstream(path_, std::ios::binary) << file; }
  std::string refusal(std::string_view file) {
    put(file);
    return message_of<std::runtime_error>([&] { read_safetensors(path_); });
  }
  TensorMap read(std::string_view file) {
    put(file);
    return read_safetensors(path_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "a.safetensors";
};

TEST_F(Safetensors, ReadsBackWhatItWrote) {
  write_safetensors(path_, example());
  EXPECT_EQ(read_safetensors(path_), example());
  write_safetensors(path_, {});
  EXPECT_EQ(read_safetensors(path_), TensorMap{});
}

TEST_F(Safetensors, HasTheLayoutOfTheFormat) {
  write_safetensors(path_, example());
  const std::string file = read_file(path_);
  std::uint64_t length = 0;
  std::memcpy(&length, file.data(), 8);
  EXPECT_EQ(length % 8, 0u);
  const auto header = nlohmann::json::parse(file.substr(8, length));
  EXPECT_EQ(header["bytes"],
            nlohmann::json::parse(R"({"dtype": "U8", "shape": [3], "data_offsets": [48, 51]})"));
  EXPECT_EQ(file.size(), 8 + length + 51);
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__" || entry["dtype"] == "U8") continue;
    const std::uint64_t width = entry["dtype"] == "F32" ? 4 : 8;
    EXPECT_EQ(entry["data_offsets"][0].get<std::uint64_t>() % width, 0u)
        << name << " is not aligned";
  }
}

TEST_F(Safetensors, ReadsAFileThatAnotherProgramWrote) {
  const std::string data("\x00\x00\x80\x3f\x00\x00\x00\x40", 8);
  const TensorMap map =
      read(file_of(R"({"w":{"data_offsets":[0,8],"dtype":"F32","shape":[1,2]}}   )", data));
  EXPECT_EQ(map.tensor("w"), (Tensor{{1, 2}, std::vector<float>{1, 2}}));
}

TEST_F(Safetensors, NoticesEveryTruncation) {
  write_safetensors(path_, example());
  const std::string file = read_file(path_);
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_TRUE(contains(refusal(file.substr(0, size)), "a.safetensors': ")) << size << " bytes";
  }
  EXPECT_TRUE(contains(refusal(file + "x"), "1 bytes behind the last tensor"));
}

TEST_F(Safetensors, NoticesAFlippedBitAnywhereButInTheNameOfTheChecksum) {
  write_safetensors(path_, example());
  const std::string file = read_file(path_);
  const std::size_t name = file.find("wordgaze.crc32");
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (i >= name && i < name + 14) continue;
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = file;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      put(flipped);
      EXPECT_THROW(read_safetensors(path_), std::runtime_error) << "byte " << i << " bit " << bit;
    }
  }
}

TEST_F(Safetensors, SaysThatNumbersWereCorrupted) {
  write_safetensors(path_, example());
  std::string file = read_file(path_);
  file.back() ^= 1;
  EXPECT_TRUE(contains(refusal(file), "the file is corrupted"));
}

TEST_F(Safetensors, RefusesForeignFiles) {
  EXPECT_TRUE(contains(refusal(""), "it has only 0 bytes; not a safetensors file"));
  EXPECT_TRUE(contains(refusal("PK\3\4 a zip file, as from torch.save"), "not a safetensors file"));
  EXPECT_TRUE(contains(refusal(file_of("not JSON", "")), "header is not JSON"));
  EXPECT_TRUE(contains(refusal(file_of("[1, 2]", "")), "not a JSON object"));
  EXPECT_TRUE(contains(refusal(file_of("{\"\xff\":1}", "")), "header is not JSON"));
  EXPECT_TRUE(contains(refusal(std::string(8, '\xff') + "{}"), "or truncated"));
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { read_safetensors(folder_ / "none"); }),
                       "none': No such file"));
}

TEST_F(Safetensors, RefusesHeadersThatLie) {
  const auto refused = [&](std::string_view entries, std::string_view reason) {
    return contains(refusal(file_of(fmt::format("{{{}}}", entries), "12345678")), reason);
  };
  const auto tensor = [](std::string_view name, std::string_view shape, std::string_view offsets,
                         std::string_view type = "F32") {
    return fmt::format(R"("{}":{{"dtype":"{}","shape":[{}],"data_offsets":[{}]}})", name, type,
                       shape, offsets);
  };
  EXPECT_TRUE(refused(tensor("a", "3", "0,12"), "said to lie at bytes 0 to 12, but there are 8"));
  EXPECT_TRUE(refused(tensor("a", "2", "8,0"), "said to lie at bytes 8 to 0"));
  EXPECT_TRUE(refused(tensor("a", "2", "0,18446744073709551615"), "said to lie"));
  EXPECT_TRUE(refused(tensor("a", "2", "-1,8"), "no valid data_offsets"));
  EXPECT_TRUE(refused(tensor("a", "2", "0"), "no valid data_offsets"));
  EXPECT_TRUE(refused(tensor("a", "2", "0,8.0"), "no valid data_offsets"));
  EXPECT_TRUE(refused(tensor("a", "-2", "0,8"), "no valid shape"));
  EXPECT_TRUE(refused(tensor("a", "3", "0,8"), "a' is F32 [3], but has 8 bytes"));
  EXPECT_TRUE(refused(tensor("a", "4294967296,4294967296", "0,8"), "but has 8 bytes"));
  EXPECT_TRUE(refused(tensor("a", "9223372036854775808", "0,8"), "but has 8 bytes"));
  EXPECT_TRUE(refused(tensor("a", "4611686018427387904", "0,8"), "but has 8 bytes"));
  EXPECT_TRUE(refused(tensor("a", "4", "0,8", "F16"), "numbers of type 'F16', expected F32"));
  EXPECT_TRUE(refused(tensor("a", "2", "0,8") + "," + tensor("a", "2", "0,8"), "has 'a' twice"));
  EXPECT_TRUE(refused(tensor("a", "2", "0,8") + "," + tensor("b", "1", "4,8"),
                      "'b' begins at byte 4, but the one before ends at 8"));
  EXPECT_TRUE(refused(tensor("a", "1", "4,8"), "'a' begins at byte 4"));
  EXPECT_TRUE(refused(tensor("a", "1", "0,4"), "4 bytes behind the last tensor"));
  EXPECT_TRUE(refused(R"("a":3)", "'a' has no valid dtype"));
  EXPECT_TRUE(refused(R"("a":{"dtype":"F32"})", "'a' has no valid shape"));
  EXPECT_TRUE(refused(R"("__metadata__":{"a":3})", "metadata is not a list of texts"));
  EXPECT_TRUE(refused(R"("a":[[[[[[1]]]]]])", "nested too deeply"));
  EXPECT_TRUE(refused(R"("__metadata__":{"wordgaze.crc32":""})", "8 bytes behind"));
}

TEST_F(Safetensors, KeepsTheLastGoodFileWhenTheDiskIsFull) {
  write_safetensors(path_, example());
  TensorMap large = example();
  large.tensors["large"] = {{100'000}, std::vector<float>(100'000)};
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] {
                         const SmallDisk disk(50'000);
                         write_safetensors(path_, large);
                       }),
                       "cannot write '" + path_.string() + "': File too large"));
  EXPECT_EQ(read_safetensors(path_), example());
}

TEST_F(Safetensors, RefusesToWriteWhatItCouldNotRead) {
  const auto refused = [&](const TensorMap& map) {
    return message_of<std::invalid_argument>([&] { write_safetensors(path_, map); });
  };
  TensorMap map;
  map.tensors["a"] = {{3}, std::vector<float>{1, 2}};
  EXPECT_EQ(refused(map), "tensor a is F32 [3] but has 2 values");
  map.tensors["a"].shape = {-1, -2};
  EXPECT_TRUE(contains(refused(map), "has 2 values"));
  map = {};
  map.tensors["__metadata__"] = {{0}, std::vector<float>{}};
  EXPECT_TRUE(contains(refused(map), "cannot be the name"));
  map = {};
  map.metadata["wordgaze.crc32"] = "0";
  EXPECT_TRUE(contains(refused(map), "reserved"));
  map = {};
  map.metadata["a"] = "\xff";
  EXPECT_TRUE(contains(refused(map), "UTF-8"));
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(Safetensors, TellsWhetherItWasChecked) {
  write_safetensors(path_, example());
  bool checked = false;
  read_safetensors(path_, &checked);
  EXPECT_TRUE(checked);
  std::string file = read_file(path_);
  file[file.find("wordgaze.crc32") + 3] ^= 1;
  put(file);
  read_safetensors(path_, &checked);
  EXPECT_FALSE(checked);
}

TEST_F(Safetensors, RefusesHeadersWithoutEnd) {
  std::string entries;
  for (int i = 0; i < 300'000; ++i) {
    entries += fmt::format(R"({}"{}":{{"dtype":"F32","shape":[0],"data_offsets":[0,0]}})",
                           i == 0 ? "" : ",", i);
  }
  EXPECT_TRUE(contains(refusal(file_of("{" + entries + "}", "")), "or truncated"));
  entries.resize(entries.find(R"(,"2500":)"));
  EXPECT_TRUE(contains(refusal(file_of("{" + entries + "}", "")), "more than 2000 names"));
  EXPECT_TRUE(contains(refusal(file_of(std::string(1'000'000, '['), "")), "nested too deeply"));
  const std::string novel(1'000'000, 'n');
  EXPECT_LT(refusal(file_of("{\"" + novel + "\":3}", "")).size(), 1000u);
  EXPECT_LT(refusal(file_of("\"" + novel, "")).size(), 1000u);
}

}  // namespace
}  // namespace wordgaze::io
