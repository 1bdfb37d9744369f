// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"
#include "eval/map_files/lattice_map.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/map_files/map_transform.hpp"
#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/mutations.hpp"

#include <fmt/format.h>
#include <liblzf/lzf.h>

namespace mapscore::eval {
namespace {

using testing::put;
using testing::read_mutations;

constexpr int kPoints = 40;
constexpr std::uint64_t kCloudMutations = 900;

/// Damaged files go the whole way to the lattice: what is read must be usable.
struct CloudMutation : testing::MapFiles {
  template <class Read>
  void survive(const std::string& name, const std::string& bytes, Read read) {
    const auto path = file(name, bytes);
    EXPECT_GT(read(path, NotFinite::refuse).size(), 0u) << "the undamaged file is read";
    const auto tally = read_mutations(bytes, kCloudMutations, [&](const std::string& mutated) {
      std::filesystem::remove(path);  // some file systems wait for the disk on replaced files
      write_file(path, mutated);
      const MapFile map = read(path, NotFinite::skip);
      ASSERT_GT(map.size(), 0u);
      for (const std::size_t size :
           {map.labels.size(), map.probabilities.size(), map.instances.size()})
        ASSERT_TRUE(size == 0 || size == map.size());
      const Labelling labelling = apply_legend(map, {}, testing::household());
      (void)on_lattice(map, labelling.classes, Pose::Identity(), 0.05, Resample::allow);
    });
    EXPECT_GT(tally.refused, 0);
    EXPECT_EQ(tally.read + tally.refused, static_cast<int>(kCloudMutations));
  }
};

struct Point {
  double x, y, z;
  int label;
};
std::vector<Point> points() {
  RandomStream draw(1, "points to damage");
  std::vector<Point> points;
  for (int n = 0; n < kPoints; ++n)
    points.push_back({draw.uniform(), draw.uniform(), draw.uniform(), n % 4});
  return points;
}

std::string ply(const std::string& format) {
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty float y\n"
      "property float z\nproperty list uchar short seen\nproperty int label\n"
      "property float probability\nelement face 2\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      format, kPoints);
  const bool swapped = format == "binary_big_endian";
  const bool ascii = format == "ascii";
  for (const Point& p : points()) {
    if (ascii) {
      bytes += fmt::format("{} {} {} 2 4 5 {} 0.5\n", p.x, p.y, p.z, p.label);
      continue;
    }
    put(bytes, p.x, swapped);
    put(bytes, static_cast<float>(p.y), swapped);
    put(bytes, static_cast<float>(p.z), swapped);
    put(bytes, std::uint8_t{2}, swapped);
    put(bytes, std::int16_t{4}, swapped);
    put(bytes, std::int16_t{5}, swapped);
    put(bytes, p.label, swapped);
    put(bytes, 0.5f, swapped);
  }
  for (int face = 0; face < 2; ++face) {
    if (ascii) {
      bytes += "3 0 1 2\n";
      continue;
    }
    put(bytes, std::uint8_t{3}, swapped);
    for (const std::int32_t vertex : {0, 1, 2}) put(bytes, vertex, swapped);
  }
  return bytes;
}

std::string pcd(const std::string& data) {
  std::string bytes = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z _ label\n"
      "SIZE 8 4 4 1 4\nTYPE F F F U U\nCOUNT 1 1 1 4 1\nWIDTH {}\nHEIGHT 2\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      kPoints / 2, kPoints, data);
  std::string x, y, z, label;
  for (const Point& p : points()) {
    if (data == "ascii") {
      bytes += fmt::format("{} {} {} 0 0 0 0 {}\n", p.x, p.y, p.z, p.label);
    } else if (data == "binary") {
      put(bytes, p.x);
      put(bytes, static_cast<float>(p.y));
      put(bytes, static_cast<float>(p.z));
      bytes += "gaps";
      put(bytes, p.label);
    } else {
      put(x, p.x);
      put(y, static_cast<float>(p.y));
      put(z, static_cast<float>(p.z));
      put(label, p.label);
    }
  }
  if (data != "binary_compressed") return bytes;
  const std::string by_field = x + y + z + label;
  std::string packed(by_field.size() + 64, '\0');
  packed.resize(lzf_compress(by_field.data(), static_cast<unsigned>(by_field.size()), packed.data(),
                             static_cast<unsigned>(packed.size())));
  put(bytes, static_cast<std::uint32_t>(packed.size()));
  put(bytes, static_cast<std::uint32_t>(by_field.size()));
  return bytes + packed;
}

class PlyMutation : public CloudMutation, public ::testing::WithParamInterface<const char*> {};
TEST_P(PlyMutation, IsReadOrRefusedInOneLine) {
  survive("map.ply", ply(GetParam()), read_ply);
}
INSTANTIATE_TEST_SUITE_P(Every, PlyMutation,
                         ::testing::Values("ascii", "binary_little_endian", "binary_big_endian"));

class PcdMutation : public CloudMutation, public ::testing::WithParamInterface<const char*> {};
TEST_P(PcdMutation, IsReadOrRefusedInOneLine) {
  survive("map.pcd", pcd(GetParam()), read_pcd);
}
INSTANTIATE_TEST_SUITE_P(Every, PcdMutation,
                         ::testing::Values("ascii", "binary", "binary_compressed"));

TEST_F(CloudMutation, CsvOfVoxelsAndOfPoints) {
  std::string voxels = "i,j,k,class,probability,instance\n", cloud = "x,y,z,class\n";
  for (const Point& p : points()) {
    voxels +=
        fmt::format("{},{},{},{},0.5,1\n", static_cast<int>(p.x * 100), static_cast<int>(p.y * 100),
                    static_cast<int>(p.z * 100), p.label == 0 ? "background" : "cup");
    cloud += fmt::format("{},{},{},{}\n", p.x, p.y, p.z, p.label);
  }
  survive("voxels.csv", voxels, read_voxel_csv);
  survive("cloud.csv", cloud, read_voxel_csv);
}

TEST_F(CloudMutation, Legends) {
  const std::string legend =
      "# labels\ncolours: {\"FF0000\": cup, \"00FF00\": background}\nids:\n  3: chair\n  -1: cup\n"
      "names: {Stuhl: &a chair, \"Sofa, gro\\xdf\": *a}\n";
  const auto path = file("legend.yaml", legend);
  EXPECT_EQ(read_legend(path, testing::household()).names.size(), 2u);
  const auto tally = read_mutations(legend, kCloudMutations, [&](const std::string& mutated) {
    std::filesystem::remove(path);
    write_file(path, mutated);
    (void)read_legend(path, testing::household());
  });
  EXPECT_GT(tally.read, 0);
  EXPECT_GT(tally.refused, 0);
}

TEST_F(CloudMutation, Transforms) {
  const std::string transform = "0 -1 0 1\n1 0 0 2 # second row\n0 0 1 3\n0 0 0 1\n";
  const auto tally = read_mutations(transform, kCloudMutations, [](const std::string& mutated) {
    EXPECT_NEAR(parse_transform(mutated, "T").linear().determinant(), 1.0, 1e-9);
  });
  EXPECT_GT(tally.read, 0);
  EXPECT_GT(tally.refused, 0);
}

}  // namespace
}  // namespace mapscore::eval
