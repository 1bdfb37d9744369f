// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/shape_files.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;

constexpr const char* kHeader = "kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz\n";

Shape shape_of(ShapeKind kind, InstanceId instance, std::string name, Eigen::Vector3d size) {
  Shape shape;
  shape.kind = kind;
  shape.instance = instance;
  shape.name = std::move(name);
  shape.size = size;
  shape.T_world_shape = exp_pose((Vector6() << 1.0 / 3.0, -2, 0.1, 0.3, -0.2, 0.7).finished());
  return shape;
}

Shape mesh_of(InstanceId instance, std::string name, int triangles) {
  Shape mesh = shape_of(ShapeKind::mesh, instance, std::move(name), {0, 0, 0});
  for (int i = 0; i < triangles; ++i)
    mesh.triangles.push_back(
        {Eigen::Vector3d(0, 0, i), Eigen::Vector3d(0.1, 0, i), Eigen::Vector3d(0, 0.7, i)});
  return mesh;
}

std::vector<Shape> table_back(const std::string& text, std::size_t instances) {
  const TemporaryFolder folder;
  write_file(folder.path() / "shapes.csv", text);
  return read_shape_table(folder.path() / "shapes.csv", instances);
}

std::vector<Shape> ply_back(const std::string& bytes, std::size_t instances) {
  const TemporaryFolder folder;
  write_file(folder.path() / "t.ply", bytes);
  return read_triangle_ply(folder.path() / "t.ply", instances);
}

TEST(ShapeTable, EveryKindComesBack) {
  const std::vector<Shape> shapes{shape_of(ShapeKind::plane, 0, "", {2, 1.0 / 3.0, 0}),
                                  shape_of(ShapeKind::sphere, 1, "a,b", {0.1, 0, 0}),
                                  shape_of(ShapeKind::capsule, 2, "say \"x\", y", {0.1, 0.2, 0}),
                                  shape_of(ShapeKind::ellipsoid, 3, "e e", {0.1, 0.2, 0.3}),
                                  shape_of(ShapeKind::cylinder, 4, "\"", {0.1, 0.2, 0}),
                                  shape_of(ShapeKind::box, 5, "box", {1, 2, 3})};
  const std::vector<Shape> back = table_back(shape_table_text(shapes), 6);
  ASSERT_EQ(back.size(), shapes.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].kind, shapes[i].kind);
    EXPECT_EQ(back[i].instance, shapes[i].instance);
    EXPECT_EQ(back[i].name, shapes[i].name);
    EXPECT_EQ(back[i].size, shapes[i].size);
    EXPECT_TRUE(back[i].T_world_shape.isApprox(shapes[i].T_world_shape, 1e-15));
  }
}

TEST(ShapeTable, RefusesBrokenLines) {
  const std::pair<const char*, const char*> cases[] = {
      {"box,0,x,0,0,0,0,0,0,1,1,1", "csv:2: expected 13 columns"},
      {"box,0,\"x,0,0,0,0,0,0,1,1,1,1", "expected 13 columns"},
      {"cone,0,x,0,0,0,0,0,0,1,1,1,1", "unknown kind 'cone'"},
      {"mesh,0,x,0,0,0,0,0,0,1,1,1,1", "unknown kind 'mesh'"},
      {"box,3,x,0,0,0,0,0,0,1,1,1,1", "instance '3' is not in"},
      {"box,1.5,x,0,0,0,0,0,0,1,1,1,1", "instance '1.5' is not in"},
      {"box,-1,x,0,0,0,0,0,0,1,1,1,1", "instance '-1' is not in"},
      {"box,0,x,nan,0,0,0,0,0,1,1,1,1", "'nan' is not a finite"},
      {"box,0,x,0,0,0,0,0,0,2,1,1,1", "not of length 1"},
      {"box,0,x,0,0,0,0,0,0,1,1,0,1", "size is not above 0"}};
  for (const auto& [line, what] : cases) {
    const std::string text = std::string(kHeader) + line + "\n";
    expect_error(what, [&] { (void)table_back(text, 3); });
  }
  expect_error("csv:1: the first line", [&] { (void)table_back("kind,name\n", 3); });
}

TEST(ShapeTable, RefusesToWriteWhatItCouldNotRead) {
  expect_error("geom 'flat'", [] {
    (void)shape_table_text({shape_of(ShapeKind::box, 0, "flat", {1, 1, 0})});
  });
  Shape lost = shape_of(ShapeKind::sphere, 0, "lost", {1, 1, 0});
  lost.T_world_shape.translation().x() = std::numeric_limits<double>::quiet_NaN();
  expect_error("geom 'lost'", [&] { (void)shape_table_text({lost}); });
}

TEST(ShapeTable, EndsOfLinesInNamesAreEscaped) {
  EXPECT_THAT(shape_table_text({shape_of(ShapeKind::sphere, 0, "a\nb", {1, 1, 0})}),
              ::testing::HasSubstr("\nsphere,0,a\\nb,"));
}

TEST(TrianglePly, MeshesComeBackInTheWorldFrame) {
  const std::vector<Shape> shapes{mesh_of(2, "seat of it", 3),
                                  shape_of(ShapeKind::box, 1, "b", {1, 1, 1}), mesh_of(1, "", 1)};
  const std::vector<Shape> back = ply_back(triangle_ply_bytes(shapes), 3);
  ASSERT_EQ(back.size(), 2u);
  for (const auto& [mesh, original] :
       {std::pair(back[0], shapes[0]), std::pair(back[1], shapes[2])}) {
    EXPECT_EQ(mesh.kind, ShapeKind::mesh);
    EXPECT_EQ(mesh.instance, original.instance);
    EXPECT_EQ(mesh.name, original.name);
    EXPECT_EQ(mesh.T_world_shape.matrix(), Pose::Identity().matrix());
    ASSERT_EQ(mesh.triangles.size(), original.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t corner = 0; corner < 3; ++corner)
        EXPECT_EQ(mesh.triangles[i][corner],
                  original.T_world_shape * original.triangles[i][corner]);
  }
}

TEST(TrianglePly, NothingIsWrittenWithoutMeshes) {
  EXPECT_EQ(triangle_ply_bytes({shape_of(ShapeKind::box, 1, "b", {1, 1, 1})}), "");
}

TEST(TrianglePly, RefusesBrokenFiles) {
  const std::string good = triangle_ply_bytes({mesh_of(2, "m", 2)});
  const std::size_t faces = good.size() - 2 * 19;
  const auto with = [&](std::size_t at, char byte) {
    std::string bad = good;
    bad[at] = byte;
    return bad;
  };
  expect_error("not a PLY", [&] { (void)ply_back("", 3); });
  expect_error("not a PLY", [&] { (void)ply_back(with(5, 'x'), 3); });
  for (std::size_t length : {good.size() - 1, good.size() - 30, good.size() / 2})
    EXPECT_THROW((void)ply_back(good.substr(0, length), 3), Error);
  expect_error("size does not fit", [&] { (void)ply_back(good + "x", 3); });
  expect_error("not a triangle", [&] { (void)ply_back(with(faces, 4), 3); });
  expect_error("vertex that is not there", [&] { (void)ply_back(with(faces + 1, 99), 3); });
  expect_error("vertex that is not there", [&] { (void)ply_back(with(faces + 4, '\x80'), 3); });
  expect_error("geom that is not there", [&] { (void)ply_back(with(faces + 15, 1), 3); });
  expect_error("instance is not in", [&] { (void)ply_back(good, 2); });
  expect_error("not finite", [&] {
    std::string bad = good;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::copy_n(reinterpret_cast<const char*>(&nan), sizeof nan, bad.end() - 2 * 19 - 24);
    (void)ply_back(bad, 3);
  });
}

TEST(TrianglePly, RefusesToWriteAnEmptyMesh) {
  expect_error("mesh 'none'", [] { (void)triangle_ply_bytes({mesh_of(0, "none", 0)}); });
}

TEST(TrianglePly, MoreNamesThanTrianglesAreRefused) {
  std::string bytes = triangle_ply_bytes({mesh_of(1, "m", 2)});
  const std::string name = "comment geom m\n";
  bytes.insert(bytes.find(name), name + name);
  expect_error("a geom has no triangles", [&] { (void)ply_back(bytes, 3); });
}

}  // namespace
}  // namespace mapscore::eval
