// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/object_file.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using mapscore::testing::TemporaryFolder;
using ::testing::HasSubstr;

ClassTable table() {
  ClassTable table;
  table.classes.push_back({1, "chair", {0, 0, 255}, true});
  table.classes.push_back({2, "tea & \"cake\"", {255, 0, 0}, true});
  return table;
}

ObjectFile two_objects() {
  ObjectFile file;
  file.map_origin_m = {0.0125, -3.5, 0.1};
  file.map_yaw_deg = 30.0;
  MapObject chair;
  chair.id = 3;
  chair.class_id = 1;
  chair.box.T_frame_box = exp_pose((Vector6() << 1.1, -2.2, 0.3, 0.1, -0.2, 2.0).finished());
  chair.box.size_m = {0.4, 0.5, 1.0 / 3.0};
  chair.last_seen_s = 12.25;
  chair.observations = 17;
  chair.misses = 4;
  chair.age = 2;
  chair.confidence = 0.7;
  MapObject cake = chair;
  cake.id = 8;
  cake.class_id = 2;
  cake.box = oriented(Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 0)));
  file.objects = {chair, cake};
  return file;
}

void expect_equal(const MapObject& a, const MapObject& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.class_id, b.class_id);
  EXPECT_TRUE(a.box.T_frame_box.isApprox(b.box.T_frame_box, 1e-14));
  EXPECT_EQ(a.box.size_m, b.box.size_m);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.last_seen_s, b.last_seen_s);
  EXPECT_EQ(a.observations, b.observations);
  EXPECT_EQ(a.misses, b.misses);
  EXPECT_EQ(a.age, b.age);
  EXPECT_EQ(a.confidence, b.confidence);
}

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  write_file(folder.path() / "objects.yaml", text);
  try {
    (void)read_objects(folder.path() / "objects.yaml", table());
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(ObjectFile, RoundTrip) {
  const TemporaryFolder folder;
  ObjectFile file = two_objects();
  file.objects[0].model = "models/\"old\"\tchair.obj";
  write_whole_file(folder.path() / "objects.yaml", object_text(file, table()));
  const ObjectFile read = read_objects(folder.path() / "objects.yaml", table());
  EXPECT_EQ(read.map_origin_m, file.map_origin_m);
  EXPECT_EQ(read.map_yaw_deg, file.map_yaw_deg);
  ASSERT_EQ(read.objects.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) expect_equal(read.objects[n], file.objects[n]);
  write_whole_file(folder.path() / "none.yaml", object_text({}, table()));
  EXPECT_TRUE(read_objects(folder.path() / "none.yaml", table()).objects.empty());
}

TEST(ObjectFile, RefusalsNameLineKeyAndMend) {
  const std::string good = object_text(two_objects(), table());
  ASSERT_EQ(refusal(good), "read");
  EXPECT_THAT(refusal(replaced(good, "misses", "mises")), HasSubstr("unknown key 'mises'"));
  EXPECT_THAT(refusal(replaced(good, "\"chair\"", "\"chairs\"")),
              HasSubstr("no class 'chairs'; there are: chair, tea"));
  EXPECT_THAT(refusal(replaced(good, "id: 8", "id: 3")), HasSubstr("not above"));
  EXPECT_THAT(refusal(replaced(good, "0.4,", "-0.4,")), HasSubstr("negative length"));
  EXPECT_THAT(refusal(replaced(good, "0.4,", "nan,")), HasSubstr("is nan; write a finite number"));
  EXPECT_THAT(refusal(replaced(good, "0.7", "1.7")), HasSubstr("from 0 to 1"));
  EXPECT_THAT(refusal(replaced(good, "format_version: 1", "format_version: 2")),
              HasSubstr("another format"));
  EXPECT_THAT(refusal(good.substr(0, good.find("objects:\n")) + "objects: 3\n"),
              HasSubstr("objects.yaml:6: objects: is 3; write a list"));
  ObjectFile foreign = two_objects();
  foreign.objects[0].class_id = 9;
  EXPECT_THROW((void)object_text(foreign, table()), Error);
  EXPECT_THROW((void)read_objects("/nowhere/objects.yaml", table()), Error);
}

TEST(ObjectFile, MutationsAreReadOrRefusedInOneLine) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "objects.yaml";
  const auto tally = mapscore::testing::read_mutations(
      object_text(two_objects(), table()), 500, [&](const std::string& bytes) {
        write_file(file, bytes);
        for (const MapObject& object : read_objects(file, table()).objects)
          EXPECT_TRUE(object.box.T_frame_box.matrix().allFinite() && object.box.size_m.allFinite());
      });
  EXPECT_GT(tally.read, 10);
  EXPECT_GT(tally.refused, 100);
}

TEST(ObjectMjcf, BodiesStandInTheWorldAndModelsAreNamed) {
  ObjectFile file = two_objects();
  file.map_origin_m = {1, 2, 0};
  file.map_yaw_deg = 0;
  file.objects[0].model = "a&b.obj";
  const std::string text = object_mjcf(file, table());
  EXPECT_THAT(text, HasSubstr("<mesh name=\"model_3\" file=\"a&amp;b.obj\"/>"));
  EXPECT_THAT(text, HasSubstr("<body name=\"tea &amp; &quot;cake&quot;_8\" pos=\"1.5 3 0\""));
  EXPECT_THAT(text, HasSubstr("type=\"box\" size=\"0.5 1 0.0005\" rgba=\"1 0 0 1\""));
  file.objects[0].model = "chair.xml";
  EXPECT_THAT(object_mjcf(file, table()), HasSubstr("<attach model=\"model_3\""));
  file.objects[0].model = "chair.step";
  EXPECT_THROW((void)object_mjcf(file, table()), Error);
}

TEST(ObjectPly, BoxesAreClosedAndFaceOutwards) {
  const std::string text = object_ply(two_objects().objects, table());
  std::istringstream lines(text.substr(text.find("end_header\n") + 11));
  std::vector<Eigen::Vector3d> corners(16);
  for (Eigen::Vector3d& p : corners) {
    int red = 0, green = 0, blue = 0, object = 0;
    lines >> p.x() >> p.y() >> p.z() >> red >> green >> blue >> object;
  }
  double volumes[2]{};
  for (int n = 0; n < 24; ++n) {
    std::size_t three = 0, a = 0, b = 0, c = 0;
    ASSERT_TRUE(lines >> three >> a >> b >> c);
    ASSERT_EQ(three, 3u);
    volumes[a / 8] += corners[a].cross(corners[b]).dot(corners[c]) / 6.0;
  }
  EXPECT_NEAR(volumes[0], 0.4 * 0.5 / 3.0, 1e-5);
  EXPECT_NEAR(volumes[1], 0.0, 1e-5);
}

}  // namespace
}  // namespace mapscore::eval
