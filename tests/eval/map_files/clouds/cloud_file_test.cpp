// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_file.hpp"

#include "core/error.hpp"
#include "eval/map_files/map_file.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mapscore::eval {
namespace {

const std::vector<Eigen::Vector3d> kTwoPoints{{0.5, -1.25, 2.0}, {3.0, 0.0, -4.5}};

TEST(CloudFile, BothFormatsComeBackWithClassAndInstance) {
  const testing::TemporaryFolder folder;
  for (const char* name : {"segment.ply", "segment.pcd"}) {
    const std::filesystem::path file = folder.path() / name;
    write_cloud(file, kTwoPoints, 7, 300);
    const MapFile map = file.extension() == ".ply" ? read_ply(file) : read_pcd(file);
    EXPECT_EQ(map.points, kTwoPoints);  // exact in single precision
    EXPECT_EQ(map.label_kind, LabelKind::id);
    EXPECT_EQ(map.labels, (std::vector<std::uint32_t>{7, 7}));
    EXPECT_EQ(map.instances, (std::vector<std::uint32_t>{300, 300}));
  }
}

TEST(CloudFile, RefusesOtherEndingsAndWritesNothing) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(write_cloud(folder.path() / "segment.xyz", kTwoPoints, 1, 1), Error);
  EXPECT_THROW(write_cloud(folder.path() / "none/segment.ply", kTwoPoints, 1, 1), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace mapscore::eval
