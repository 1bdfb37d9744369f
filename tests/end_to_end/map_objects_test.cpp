// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

// The object map by the built program.

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;

class MapObjects : public TinyStudy {
 protected:
  [[nodiscard]] Outcome map(const std::string& source, const std::string& output,
                            const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"objects", source, "-o", path(output), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
};

TEST_F(MapObjects, WritesWhatItFoundAndScoresIt) {
  const Outcome outcome = map(path("tiny"), "map", {"--format", "csv"});
  expect_done(outcome);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, ::testing::StartsWith("class,truth,found,missed,false,"));
  EXPECT_THAT(outcome.out, HasSubstr("\ncrate,1,1,0,0,"));
  EXPECT_THAT(bytes_of(path("map/objects.yaml")), HasSubstr("class: \"crate\""));
  EXPECT_THAT(bytes_of(path("map/objects.ply")), ::testing::StartsWith("ply\n"));
  EXPECT_THAT(bytes_of(path("map/objects.xml")), HasSubstr("crate_1"));
  expect_done(map(path("tiny"), "text"));
  const Outcome json = map(path("tiny"), "json", {"--format", "json"});
  expect_done(json);
  EXPECT_THAT(json.out, HasSubstr("\"crate\""));
}

TEST_F(MapObjects, StudyAndRecordingGiveTheSameObjects) {
  expect_done(
      map(path("tiny"), "recording",
          {"--method", "erosion", "--set", "methods.erosion.segmentation.erosion.radius_px=2"}));
  expect_done(map(study(), "study", {"--method", "erosion", "--set", "map_origin_m=[0, 0, 0]"}));
  const std::string objects = bytes_of(path("recording/objects.yaml"));
  EXPECT_GT(objects.size(), 100u);
  EXPECT_EQ(objects, bytes_of(path("study/objects.yaml")));
}

TEST_F(MapObjects, GoesOnFromAMap) {
  expect_done(map(path("tiny"), "first"));
  expect_done(map(path("tiny"), "second", {"--start", path("first/objects.yaml")}));
  EXPECT_THAT(bytes_of(path("first/objects.yaml")), HasSubstr("observations: 4"));
  EXPECT_THAT(bytes_of(path("second/objects.yaml")), HasSubstr("observations: 8"));
}

TEST_F(MapObjects, BadInputIsRefusedInOneLine) {
  expect_refused(map(path("nothing"), "map"), {"nothing"});
  expect_refused(map(path("tiny"), "map", {"--method", "guess"}), {"guess", "direct, erosion"});
  expect_refused(map(study(), "map", {"--seed", "2"}), {"--seed 2", "0 to 1"});
  expect_refused(map(path("tiny"), "map", {"--face_share", "0"}), {"--face_share"});
  expect_refused(map(path("tiny"), "map", {"--update", "most"}), {"--update", "quantile"});
  expect_refused(map(path("tiny"), "map", {"--set", "perception=guess"}), {"perception", "guess"});
  expect_refused(map(path("tiny"), "map", {"--start", path("no.yaml")}), {"no.yaml"});
  write_text(path("bad.yaml"), "format_version: 1\nobjects: 7\n");
  expect_refused(map(path("tiny"), "map", {"--start", path("bad.yaml")}), {"bad.yaml"});
  EXPECT_FALSE(std::filesystem::exists(path("map/objects.yaml")));
}

}  // namespace
}  // namespace mapscore::testing
