// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/fusion_rule.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

#include <sstream>

// One map read at several voxel sizes by the built program.

namespace mapscore::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class MapResolutions : public TinyStudy {
 protected:
  MapResolutions() {
    expect_done(
        mapscore({"map", path("tiny"), "-o", path("map.ot"), "--segmentation", "direct", "-q"}));
  }

  [[nodiscard]] Outcome read(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"resolutions", path("map.ot"), "--truth", path("tiny"),
                                       "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
};

TEST_F(MapResolutions, OneTimeIsTheMapItself) {
  const Outcome outcome = read({"--format", "csv", "--times", "1"});
  expect_done(outcome);
  const Outcome score = mapscore({"score", path("map.ot"), "--truth", path("tiny"), "--tidy"});
  expect_done(score);
  const auto figure = [&](const std::string& name) {
    const std::size_t at = score.out.find("\npooled," + name + ",") + name.size() + 9;
    return score.out.substr(at, score.out.find('\n', at) - at);
  };
  EXPECT_EQ(outcome.out.substr(0, outcome.out.find("precision")), "times,voxel_m,voxels,truth,");
  EXPECT_THAT(outcome.out, HasSubstr("\n1,0.05," + figure("predicted") + "," + figure("visible")));
}

TEST_F(MapResolutions, CoarserVoxelsAreFewerAndFindTheCrateToo) {
  const Outcome outcome = read({"--format", "csv", "--color", path("colour.ot")});
  expect_done(outcome);
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  int before = 1 << 30, sizes = 0;
  for (int times = 1; std::getline(lines, line); times *= 2, ++sizes) {
    EXPECT_THAT(line, StartsWith(std::to_string(times) + ","));
    const std::size_t at = line.find(',', line.find(',') + 1) + 1;
    const int voxels = std::stoi(line.substr(at));
    EXPECT_LT(voxels, before);
    EXPECT_GT(voxels, 0);
    before = voxels;
    // Every voxel that was seen holds a point of the crate.
    EXPECT_THAT(line, HasSubstr(",1.000,")) << "recall";
    EXPECT_GT(bytes_of(path("colour_x" + std::to_string(times) + ".ot")).size(), 100u);
  }
  EXPECT_EQ(sizes, 4);
}

TEST_F(MapResolutions, EveryRuleAndFormat) {
  for (const std::string& rule : kinds_of(FusionRule{})) {
    write_text(path("rule.yaml"), "recording: tiny\nfusion: {" + rule + ": {}}\n" +
                                      "methods: {direct: {segmentation: {direct: {}}}}\n");
    expect_done(
        mapscore({"map", path("tiny"), "-o", path("map.ot"), "-q", "--study", path("rule.yaml")}));
    const Outcome outcome = read({"--fusion", rule, "--times", "2,8", "--format", "csv"});
    expect_done(outcome);
    EXPECT_THAT(outcome.out, HasSubstr(",1.000,1.000,1.000\n")) << rule;
  }
  const Outcome json = read({"--format", "json", "--times", "2"});
  expect_done(json);
  EXPECT_THAT(json.out, HasSubstr("\"voxel_m\": 0.1"));
}

TEST_F(MapResolutions, BadInputIsRefusedInOneLine) {
  expect_refused(read({"--times", "3"}), {"--times", "3", "1, 2, 4, 8"});
  expect_refused(read({"--times", "2048"}), {"--times", "2048"});
  expect_refused(read({"--times", "2,2"}), {"--times", "twice"});
  expect_refused(read({"--color", path("no/colour.ot")}), {"--color", "folder"});
  expect_refused(read({"--color", path("colour.png")}), {"--color", ".ot"});
  expect_refused(read({"--fusion", "guess"}), {"--fusion", "guess"});
  expect_refused(read({"--fusion", "vote"}), {"map.ot", "--fusion vote"});
  expect_refused(read({"--detect", "cup"}), {"cup"});
  expect_refused(read({"--picture", path("sizes.jpg")}), {"sizes.jpg", ".png"});
  expect_refused(read({"--view", "0", "0", "1", "1", "0", "0"}), {"--view", "--picture"});
  expect_refused(mapscore({"resolutions", path("no.ot"), "--truth", path("tiny")}), {"no.ot"});
  write_text(path("bad.ot"), "# Octomap OcTree file\nid OcTree\nsize 0\nres 0.05\ndata\n");
  expect_refused(mapscore({"resolutions", path("bad.ot"), "--truth", path("tiny")}),
                 {"bad.ot", "not a semantic map"});
  expect_refused(mapscore({"resolutions", path("map.ot"), "--truth", path("nowhere")}),
                 {"nowhere"});
}

TEST_F(MapResolutions, MapsOfChosenClassesAlone) {
  const auto map = [&](const char* classes) {
    return mapscore({"map", path("tiny"), "-o", path("chosen.ot"), "--detect", classes, "-q"});
  };
  const Outcome all = map("all");
  expect_done(all);
  EXPECT_THAT(all.out, HasSubstr("8 detections"));
  EXPECT_THAT(all.out, HasSubstr("wall"));
  const Outcome wall = map("wall");
  expect_done(wall);
  EXPECT_THAT(wall.out, HasSubstr("4 detections"));
  EXPECT_THAT(wall.out, ::testing::Not(HasSubstr("crate")));
  expect_refused(map("cup"), {"detect", "cup"});
}

}  // namespace
}  // namespace mapscore::testing
