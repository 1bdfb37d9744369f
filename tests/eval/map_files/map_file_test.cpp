// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"

#include "core/mapping/semantic_map.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

namespace mapscore::eval {
namespace {

using testing::expect_error;

struct MapFileByEnding : testing::MapFiles {};

TEST_F(MapFileByEnding, EachIsReadByItsReader) {
  const auto ply = file("a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                        "property float y\nproperty float z\nend_header\n1 nan 3\n");
  expect_error("a.ply: 1 of 1 points are not finite", [&] { (void)read_map_file(ply); });
  expect_error("a.ply: the map is empty", [&] { (void)read_map_file(ply, NotFinite::skip); });
  const auto pcd =
      file("a.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n1 2 3\n1 2 nan\n");
  EXPECT_EQ(read_map_file(pcd, NotFinite::skip).points.size(), 1u);
  EXPECT_EQ(read_map_file(file("a.csv", "1,2,3,cup\n")).voxels.size(), 1u);
  SemanticMap octree(0.05);
  octree.fuse(std::vector<VoxelHit>{{{1, 2, 3}, 1, 1, 1.0}}, 1, BlendRule{0.5});
  octree.save(folder_ / "a.ot");
  EXPECT_EQ(read_map_file(folder_ / "a.ot").edge_m, 0.05);
}

TEST_F(MapFileByEnding, CapitalsDoNotMatter) {
  EXPECT_EQ(read_map_file(file("A.CSV", "1,2,3,cup\n")).voxels.size(), 1u);
  EXPECT_TRUE(has_ending_of_a_map("folder/a.Ply"));
  EXPECT_FALSE(has_ending_of_a_map("folder.ply/a"));
}

TEST_F(MapFileByEnding, OtherEndingsAreRefusedWithTheListOfThose) {
  for (const char* name : {"a.pcl", "a", "a.ply.gz"})
    expect_error("maps are read from .ot, .bt, .ply, .pcd, .csv; convert it to one of these",
                 [&] { (void)read_map_file(file(name, "ply\n")); });
}

TEST_F(MapFileByEnding, MissingFilesAndFoldersAreRefusedByName) {
  std::filesystem::create_directories(folder_ / "folder.csv");
  for (const char* name : {"none.ot", "none.bt", "none.ply", "none.pcd", "none.csv", "folder.csv"})
    expect_error(name, [&] { (void)read_map_file(folder_ / name); });
}

}  // namespace
}  // namespace mapscore::eval
