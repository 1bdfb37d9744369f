// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_file.hpp"

#include "core/error.hpp"
#include "tests/eval/truth/truth_scenes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <sstream>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

class TruthFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("truth_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder_;
  const SurfaceTruth truth_{{{{-1, 2, 3}, 0, true}, {{0, 0, 10}, 1, false}, {{0, 0, 10}, 2, false}},
                            0.1};
};

/// Red owns voxel (0, 0, 10), which holds 3 samples.
VisibleTruth three_samples() {
  return {{{{0, 0, 10}, 1, 3}}, 0.1};
}

TEST_F(TruthFile, CsvHoldsOneRowAVoxelAndClass) {
  const VisibleTruth visible = three_samples();
  write_truth(folder_ / "truth.csv", truth_, &visible, test::four_classes());
  EXPECT_EQ(content(folder_ / "truth.csv"),
            "i,j,k,class,touch_only,samples\n"
            "-1,2,3,background,1,0\n"
            "0,0,10,red,0,3\n"
            "0,0,10,green,0,0\n");
  EXPECT_FALSE(fs::exists(folder_ / "truth.csv.partial"));
  write_truth(folder_ / "truth.csv", truth_, nullptr, test::four_classes());  // replaces the file
  EXPECT_NE(content(folder_ / "truth.csv").find("0,0,10,red,0,0\n"), std::string::npos);
}

TEST_F(TruthFile, CsvQuotesNamesThatNeedIt) {
  ClassTable table = test::four_classes();
  table.classes[1].name = "cup, \"red\"";
  write_truth(folder_ / "truth.csv", truth_, nullptr, table);
  EXPECT_NE(content(folder_ / "truth.csv").find("0,0,10,\"cup, \"\"red\"\"\",0,0\n"),
            std::string::npos);
}

TEST_F(TruthFile, PlyHoldsCentresAndColours) {
  const VisibleTruth visible = three_samples();
  write_truth(folder_ / "truth.ply", truth_, &visible, test::four_classes());
  const std::string bytes = content(folder_ / "truth.ply");
  EXPECT_EQ(bytes.rfind("ply\nformat binary_little_endian 1.0\nelement vertex 3\n", 0), 0u);
  const std::size_t body = bytes.find("end_header\n") + 11;
  constexpr std::size_t kRow = 3 * 4 + 3 + 2 + 1 + 4;
  ASSERT_EQ(bytes.size(), body + 3 * kRow);
  const auto at = [&](std::size_t row, std::size_t offset, unsigned count) {
    std::uint32_t bits = 0;
    for (unsigned b = 0; b < count; ++b) {
      bits |= std::uint32_t{static_cast<std::uint8_t>(bytes[body + row * kRow + offset + b])}
              << (8 * b);
    }
    return bits;
  };
  EXPECT_FLOAT_EQ(std::bit_cast<float>(at(0, 0, 4)), -0.05f);
  EXPECT_FLOAT_EQ(std::bit_cast<float>(at(0, 4, 4)), 0.25f);
  EXPECT_FLOAT_EQ(std::bit_cast<float>(at(1, 8, 4)), 1.05f);
  EXPECT_EQ(at(1, 12, 3), 0x0000ffu);  // red, lowest byte first
  EXPECT_EQ(at(2, 12, 3), 0x00ff00u);
  EXPECT_EQ(at(2, 15, 2), 2u);
  EXPECT_EQ(at(0, 17, 1), 1u);
  EXPECT_EQ(at(1, 18, 4), 3u);
  EXPECT_EQ(at(2, 18, 4), 0u);
}

TEST_F(TruthFile, RefusesWhatItCannotWrite) {
  const ClassTable table = test::four_classes();
  EXPECT_THROW(write_truth(folder_ / "truth.txt", truth_, nullptr, table), Error);
  EXPECT_THROW(write_truth(folder_ / "nowhere" / "truth.csv", truth_, nullptr, table), Error);
  const VisibleTruth other({}, 0.05);
  EXPECT_THROW(write_truth(folder_ / "truth.csv", truth_, &other, table), Error);
  fs::create_directories(folder_ / "taken.csv" / "inside");
  EXPECT_THROW(write_truth(folder_ / "taken.csv", truth_, nullptr, table), Error);
  EXPECT_FALSE(fs::exists(folder_ / "taken.csv.partial"));
}

}  // namespace
}  // namespace mapscore::eval
