// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <string>

// The segments of one frame, written by the built program.

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class SegmentFrame : public TinyStudy {
 protected:
  [[nodiscard]] Outcome segment(const std::string& output,
                                const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"segment", path("tiny"), "-o", path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }

  /// Points that a cloud's header promises.
  [[nodiscard]] int points(const std::string& file) const {
    const std::string text = bytes_of(path(file));
    const std::string key = file.ends_with(".ply") ? "element vertex " : "POINTS ";
    const std::size_t at = text.find(key);
    return at == std::string::npos ? -1 : std::stoi(text.substr(at + key.size()));
  }
};

TEST_F(SegmentFrame, EveryMethodWritesPointsVoxelsAndBoxes) {
  for (const std::string method : {"direct", "erosion", "region_growing", "edge_aligned",
                                   "largest_component", "dbscan", "depth_segments"}) {
    std::vector<std::string> flags{"--method", method};
    if (method == "depth_segments") flags.insert(flags.end(), {"--min_segment_px", "20"});
    if (method == "erosion") flags.insert(flags.end(), {"--radius_px", "1"});
    const Outcome outcome = segment(method, flags);
    expect_done(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("crate"));
    const bool says_fit =
        outcome.out.starts_with("fit: turned by ") &&
        outcome.out.find("right within 2 px with a probability of") != std::string::npos;
    EXPECT_EQ(says_fit, method == "edge_aligned") << outcome.out;
    const std::string csv = bytes_of(path(method + "/segments.csv"));
    EXPECT_THAT(csv, StartsWith("instance,name,class,"));
    EXPECT_THAT(csv, HasSubstr("\n1,crate_1,crate,"));
    const std::string stem = method + "/instance_00001";
    EXPECT_GT(points(stem + ".pcd"), 20) << method;
    EXPECT_EQ(points(stem + ".pcd"), points(stem + ".ply"));
    EXPECT_GT(points(stem + "_voxels.pcd"), 3);
    EXPECT_EQ(points(stem + "_voxels.pcd"), points(stem + "_voxels.ply"));
  }
  EXPECT_LT(points("erosion/instance_00001.pcd"), points("direct/instance_00001.pcd"));
}

TEST_F(SegmentFrame, FramesDiffer) {
  expect_done(segment("first", {"--frame", "0"}));
  expect_done(segment("last", {"--frame", "3"}));
  EXPECT_NE(bytes_of(path("first/segments.csv")), bytes_of(path("last/segments.csv")));
}

TEST_F(SegmentFrame, BadInputIsRefusedInOneLine) {
  expect_refused(segment("bad", {"--frame", "4"}), {"frame", "4"});
  expect_refused(segment("bad", {"--frame", "-1"}), {"frame", "-1"});
  expect_refused(segment("bad", {"--method", "guess"}), {"--method", "guess"});
  expect_refused(segment("bad", {"--voxel_m", "0"}), {"--voxel_m"});
  expect_refused(segment("bad", {"--seed", "nose"}), {"--seed", "nose"});
  expect_refused(mapscore({"segment", path("nowhere"), "-o", path("bad")}), {"nowhere"});
  expect_refused(segment("bad", {"--radius_px", "2"}), {"--radius_px", "erosion"});
  expect_refused(segment("bad", {"--method", "erosion", "--seed", "depth_mode"}),
                 {"--seed", "region_growing"});
  EXPECT_FALSE(std::filesystem::exists(path("bad")));
  expect_done(segment("first", {}));
  expect_refused(segment("first", {"--frame", "1"}), {"first", "empty folder"});
}

}  // namespace
}  // namespace mapscore::testing
