// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"
#include "eval/map_files/map_file.hpp"
#include "files/file_bytes.hpp"
#include "tests/eval/map_files/octree_maps.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <vector>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMutations = 1500;

/// Damaged octrees are read or refused; some are read, since a file has no checksum.
struct DamagedOctree : ::testing::Test {
  /// Reads mutations of `file` as `again`, which ends as it does.
  void expect_read_or_refused(const std::string& again) {
    const std::string whole = read_file(folder_.path() / "map");
    const auto damaged = folder_.path() / again;
    const auto tally = testing::read_mutations(whole, kMutations, [&](const std::string& bytes) {
      std::filesystem::remove(damaged);  // some file systems wait for the disk on replaced files
      write_file(damaged, bytes);
      const MapFile map = read_octree(damaged);
      ASSERT_GT(map.size(), 0u);
      ASSERT_EQ(map.occupied.size(), map.size());
      ASSERT_EQ(map.labels.size(), map.label_kind == LabelKind::none ? 0 : map.size());
      for (const double probability : map.probabilities)
        ASSERT_TRUE(probability >= 0.0 && probability <= 1.0);
    });
    EXPECT_GT(tally.read, 10);
    EXPECT_GT(tally.refused, 500);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "map";
};

TEST_F(DamagedOctree, Plain) {
  testing::write_ot(testing::plain_tree(0.2), file_);
  expect_read_or_refused("damaged.ot");
}

TEST_F(DamagedOctree, Colour) {
  testing::write_ot(testing::colour_tree(), file_);
  expect_read_or_refused("damaged.ot");
}

TEST_F(DamagedOctree, Semantic) {
  testing::semantic_map().save(file_);
  expect_read_or_refused("damaged.ot");
}

/// The semantic map with a colour in each voxel.
SemanticMap coloured_map() {
  SemanticMap map = testing::semantic_map();
  for (const MapVoxel& voxel : map.voxels())
    map.add_colours(std::vector<ColouredPoint>{{centre_of(voxel.key, map.edge_m()), {200, 30, 4}}});
  return map;
}

TEST_F(DamagedOctree, SemanticWithColour) {
  coloured_map().save(file_);
  expect_read_or_refused("damaged.ot");
}

TEST_F(DamagedOctree, Binary) {
  testing::write_bt(testing::plain_tree(0.2), file_);
  expect_read_or_refused("damaged.bt");
}

TEST_F(DamagedOctree, SemanticMapLoadsOrRefuses) {
  coloured_map().save(file_);
  const std::string whole = read_file(file_);
  const auto damaged = folder_.path() / "damaged.ot";
  const auto tally = testing::read_mutations(whole, kMutations, [&](const std::string& bytes) {
    std::filesystem::remove(damaged);
    write_file(damaged, bytes);
    const SemanticMap map = SemanticMap::load(damaged);
    ASSERT_LE(map.voxels().size(), kMostMapVoxels);
  });
  EXPECT_GT(tally.read, 10);
  EXPECT_GT(tally.refused, 500);
}

}  // namespace
}  // namespace mapscore::eval
