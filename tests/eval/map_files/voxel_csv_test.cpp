// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"
#include "eval/truth/truth_file.hpp"
#include "files/csv.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

#include <limits>

namespace mapscore::eval {
namespace {

using testing::expect_error;
using testing::Labels;
using Names = std::vector<std::string>;
using Voxels = std::vector<VoxelKey>;

struct VoxelCsv : testing::MapFiles {
  MapFile read(const std::string& text, NotFinite not_finite = NotFinite::refuse) {
    return read_voxel_csv(file("map.csv", text), not_finite);
  }
  void expect_refusal(const std::string& text, const std::string& part) {
    const auto path = file("map.csv", text);
    expect_error(part, [&] { (void)read_voxel_csv(path); });
  }
};

TEST_F(VoxelCsv, RowsWithAndWithoutAHeader) {
  for (const char* head : {"", "i,j,k,class\n", "\xef\xbb\xbfi, j ,k,class\r\n", "I,J,K,Class\n"}) {
    const MapFile map = read(head + std::string("0,-1,2,cup\n\n5,6,7, chair \r\n0,0,0,cup"));
    EXPECT_EQ(map.voxels, (Voxels{{0, -1, 2}, {5, 6, 7}, {0, 0, 0}}));
    EXPECT_EQ(map.label_kind, LabelKind::name);
    EXPECT_EQ(map.names, (Names{"cup", "chair"}));
    EXPECT_EQ(map.labels, (Labels{0, 1, 0}));
    EXPECT_EQ(map.edge_m, 0.0);
    EXPECT_TRUE(map.points.empty() && map.probabilities.empty() && map.instances.empty());
  }
}

TEST_F(VoxelCsv, GeometryAloneProbabilitiesAndInstances) {
  EXPECT_EQ(read("1,2,3\n").label_kind, LabelKind::none);
  const MapFile map = read("1,2,3,cup,0.25,7\n1,2,4,cup,1,0\n");
  EXPECT_EQ(map.probabilities, (std::vector<double>{0.25, 1.0}));
  EXPECT_EQ(map.instances, (Labels{7, 0}));
  const MapFile swapped = read("instance,k,class,j,i\n9,3,cup,2,1\n");
  EXPECT_EQ(swapped.voxels, (Voxels{{1, 2, 3}}));
  EXPECT_EQ(swapped.instances, Labels{9});
  EXPECT_TRUE(swapped.probabilities.empty());
}

TEST_F(VoxelCsv, ClassesAreIdsOnlyWhenAllAreWholeNumbers) {
  const MapFile ids = read("0,0,0,12\n0,0,1,-1\n0,0,2,\"12\"\n");
  EXPECT_EQ(ids.label_kind, LabelKind::id);
  EXPECT_EQ(ids.labels, (Labels{12, 0xffffffffu, 12}));
  const MapFile names = read("0,0,0,12\n0,0,1,cup\n");
  EXPECT_EQ(names.label_kind, LabelKind::name);
  EXPECT_EQ(names.names, (Names{"12", "cup"}));
}

TEST_F(VoxelCsv, Points) {
  const MapFile map = read("x,y,z,class\n0.5,-1e-2,3,cup\n1,1,1,cup\n");
  ASSERT_EQ(map.points.size(), 2u);
  EXPECT_EQ(map.points[0], Eigen::Vector3d(0.5, -1e-2, 3));
  EXPECT_TRUE(map.voxels.empty());
  const std::string holes = "x,y,z,class\n0,0,nan,cup\n1,2,3,chair\n";
  expect_refusal(holes, "1 of 2 points are not finite; leave them out with --skip_nan");
  const MapFile seen = read(holes, NotFinite::skip);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen.names[seen.labels[0]], "chair");
  const auto path = file("nan.csv", "x,y,z\ninf,0,0\n");
  expect_error("none of its 1 points is finite",
               [&] { (void)read_voxel_csv(path, NotFinite::skip); });
}

TEST_F(VoxelCsv, QuotedNames) {
  EXPECT_EQ(read("0,0,0,\"a, \"\"b\"\"\" \n").names, Names{"a, \"b\""});
  expect_refusal("0,0,0,\"cup\n", "map.csv:1: a quote is not closed");
  expect_refusal("0,0,0,\"cup\"s\n", "map.csv:1: a quote is not closed, or text follows it");
}

TEST_F(VoxelCsv, DoubledVoxelsNameBothLines) {
  expect_refusal("0,0,0,cup\n1,1,1,cup\n0,0,0,chair\n", "map.csv:3: voxel 0,0,0 stands at ");
  expect_refusal("0,0,0,cup\n1,1,1,cup\n0,0,0,chair\n", "map.csv:1 already; keep one");
  expect_refusal("i,j,k,samples\n0,0,0,0\n0,0,0,0\n", "map.csv:3: voxel 0,0,0 stands at");
}

/// The table that `mapscore truth` writes has a row for each class that touches a voxel.
TEST_F(VoxelCsv, TheTruthsOwnTableKeepsTheOwnersRows) {
  const SurfaceTruth truth({{{-1, 2, 3}, 0, true},
                            {{0, 0, 10}, 1, false},
                            {{0, 0, 10}, 2, false},
                            {{0, 0, 11}, 1, false},
                            {{0, 0, 11}, 2, false},
                            {{0, 0, 12}, 2, false},
                            {{0, 0, 12}, 3, false}},
                           0.1);
  const VisibleTruth visible({{{0, 0, 10}, 1, 3}, {{0, 0, 11}, 2, 5}}, 0.1);
  write_truth(folder_ / "truth.csv", truth, &visible, testing::household());
  const MapFile map = read_voxel_csv(folder_ / "truth.csv");
  EXPECT_EQ(map.voxels, (Voxels{{-1, 2, 3}, {0, 0, 10}, {0, 0, 11}, {0, 0, 12}}));
  Names classes;
  for (const std::uint32_t label : map.labels) classes.push_back(map.names[label]);
  EXPECT_EQ(classes, (Names{"background", "cup", "chair", "chair"}));
  expect_refusal("i,j,k,class,samples\n0,0,0,cup,1\n0,0,0,chair,2\n", "map.csv:3: voxel 0,0,0");
}

TEST_F(VoxelCsv, BadRows) {
  expect_refusal("", "the map is empty");
  expect_refusal("i,j,k,class\n\n", "map.csv: the map is empty");
  expect_refusal("i,j,k,klass\n", "map.csv:1: unknown column 'klass'; known are i, j, k,");
  expect_refusal("i,j,k,i\n", "map.csv:1: column 'i' stands twice");
  expect_refusal("i,j,class\n", "map.csv:1: the header needs i,j,k of voxels or x,y,z of points");
  expect_refusal("i,j,k,x,y,z\n", "the header needs i,j,k of voxels or x,y,z of points");
  expect_refusal("i,j,k,x\n", "the header needs i,j,k of voxels or x,y,z of points");
  expect_refusal("1,2\n", "map.csv:1: 2 cells, and the file has no header: write x,y,z,class");
  expect_refusal("0,1,2,cup\n0.5,1.25,2,cup\n",
                 "map.csv:2: i '0.5' is no whole number within +-1000000; the file has no header: "
                 "write x,y,z,class above points in metres, i,j,k,class above voxels");
  expect_refusal("0,0,0,cup\n0,0,1\n", "map.csv:2: 3 cells, the first line has 4");
  expect_refusal("0,0,0.5,cup\n", "map.csv:1: k '0.5' is no whole number within +-1000000");
  expect_refusal("0,0,1000001,cup\n", "map.csv:1: k '1000001' is no whole number");
  expect_refusal("0,0,0,\n", "map.csv:1: the class is empty");
  expect_refusal("0,0,0,cup,1.5\n", "map.csv:1: probability 1.5 is not in [0, 1]");
  expect_refusal("0,0,0,cup,1,-2\n", "map.csv:1: instance '-2' is no whole number from 0 up");
  expect_refusal("x,y,z\n0,0,a\n", "map.csv:2: z 'a' is no number");
}

TEST_F(VoxelCsv, LinesOfManyCellsAreRefusedBeforeAllAreHeld) {
  const std::string commas(1000, ',');
  EXPECT_EQ(csv_cells(commas, 3)->size(), 4u);
  EXPECT_EQ(csv_cells(",,", 3)->size(), 3u);
  const std::string what = "more than 11 cells; the columns of a map are i, j, k, x,";
  expect_refusal("i,j,k" + commas + "\n", "map.csv:1: " + what);
  expect_refusal("i,j,k\n1,2,3" + commas + "\n", "map.csv:2: " + what);
}

TEST_F(VoxelCsv, MoreClassesThanATableCanHaveAreRefused) {
  std::string text = "x,y,z,class\n";
  for (int n = 0; n < 1 << 16; ++n) text += "1,1,1," + std::to_string(n) + "\n";
  EXPECT_EQ(read(text).labels.size(), std::size_t{1 << 16});
  expect_refusal(text + "1,1,1,one more\n", "map.csv:65538: more than 65536 different classes");
}

}  // namespace
}  // namespace mapscore::eval
