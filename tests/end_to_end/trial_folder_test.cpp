// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

// `mapscore trial` and `mapscore map` of what it wrote, by the built program.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class TrialVerb : public TinyStudy {
 protected:
  [[nodiscard]] Outcome trial(const std::string& name,
                              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"trial", study(), "-o", path(name), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
  [[nodiscard]] Outcome map(const std::string& name, const std::string& output,
                            const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", path(name), "-o", path(output), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }
  /// The map that `run` writes of the same trial.
  [[nodiscard]] std::string map_of_run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run", study(), "-o", results(), "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_done(mapscore(arguments));
    std::string bytes;
    for (const auto& entry : fs::recursive_directory_iterator(results() + "/runs"))
      if (entry.path().filename() == "map.ot") bytes = bytes_of(entry.path());
    fs::remove_all(results());
    return bytes;
  }
};

TEST_F(TrialVerb, FolderIsMappedAsRunMapsTheTrial) {
  const std::vector<std::string> faults{"--set", "faults.pose.sigma_xy_m=0.04",
                                        "--set", "faults.depth.axial=2",
                                        "--set", "faults.labels.boundary_px=1"};
  for (const char* method : {"direct", "erosion"}) {
    std::vector<std::string> more{"--method", method, "--seed", "1"};
    more.insert(more.end(), faults.begin(), faults.end());
    expect_done(trial("trial", more));
    const Outcome mapped = map("trial", "map.ot");
    expect_done(mapped);
    EXPECT_THAT(mapped.out, HasSubstr("4 of 4 label images mapped"));
    EXPECT_GT(bytes_of(path("map.ot")).size(), 300u);
    EXPECT_EQ(bytes_of(path("map.ot")), map_of_run(more)) << method;
    fs::remove_all(path("trial"));
  }
}

// Under noise of depth and pose, whose draws are numbered by frame.
TEST_F(TrialVerb, KeyFramesAreMappedFromAFolderAsByRunAndAsTheyAreNamed) {
  const std::vector<std::string> faults{"--set", "faults.pose.sigma_xy_m=0.002", "--set",
                                        "faults.depth.axial=2"};
  std::vector<std::string> all = faults, keys = faults;
  keys.insert(keys.end(),
              {"--set", "methods.direct.frames={key_frames: {key_way_m: 0.15, key_overlap: 0}}"});
  expect_done(trial("keys", keys));
  const Outcome mapped = map("keys", "keys.ot");
  expect_done(mapped);
  EXPECT_THAT(mapped.out, HasSubstr("2 of 4 label images mapped; 2 left out as no key frames"));
  EXPECT_TRUE(bytes_of(path("keys.ot")) == map_of_run(keys));
  expect_done(trial("all", all));
  expect_done(map("all", "named.ot", {"--frames", "0,2"}));
  EXPECT_TRUE(bytes_of(path("keys.ot")) == bytes_of(path("named.ot")));
  expect_done(map("all", "all.ot"));
  EXPECT_TRUE(bytes_of(path("keys.ot")) != bytes_of(path("all.ot")));
}

TEST_F(TrialVerb, CellIsOneOfTheSweep) {
  expect_done(trial("zero"));
  expect_done(trial("dosed", {"--cell", "magnitude_m=0.03"}));
  expect_done(trial("set", {"--set", "sweep={}", "--set", "misregistration.magnitude_m=0.030"}));
  EXPECT_NE(bytes_of(path("dosed/trial.yaml")), bytes_of(path("zero/trial.yaml")));
  EXPECT_EQ(bytes_of(path("dosed/trial.yaml")), bytes_of(path("set/trial.yaml")));
  expect_refused(trial("no", {"--cell", "magnitude_m=0.04"}), {"--cell", "0, 0.03"});
  expect_refused(trial("no", {"--cell", "voxel_m=0.04"}), {"--cell", "not swept", "--set"});
  expect_refused(trial("no", {"--cell", "voxel_m"}), {"--cell", "path=value"});
  expect_refused(trial("no", {"--seed", "2"}), {"no trial of seed 2"});
  expect_refused(trial("no", {"--method", "other"}), {"other", "direct erosion"});
  expect_refused(trial("zero"), {"zero", "exists already"});
  expect_refused(trial("study.yaml/trial"), {"cannot create"});
  EXPECT_FALSE(fs::exists(path("no")));
  EXPECT_FALSE(fs::exists(path("no.partial")));
}

TEST_F(TrialVerb, MapTakesNoFlagThatTheFolderDecides) {
  expect_done(trial("trial"));
  for (const std::vector<std::string>& flags : {std::vector<std::string>{"--voxel_m", "0.1"},
                                                {"--study", study()},
                                                {"--segmentation", "erosion"},
                                                {"--detect", "all"},
                                                {"--yaw_deg", "3"}})
    expect_refused(map("trial", "map.ot", flags), {flags.front(), "method.yaml"});
  EXPECT_FALSE(fs::exists(path("map.ot")));
  expect_done(map("trial", "part.ot", {"--frames", "0,1", "--ply", path("part.ply")}));
}

TEST_F(TrialVerb, MapCanBeScored) {
  expect_done(trial("trial", {"--set", "map_origin_m=[0.01, 0.02, 0.03]"}));
  EXPECT_THAT(bytes_of(path("trial/trial.yaml")), HasSubstr("map_origin_m: [0.01, 0.02, 0.03]"));
  expect_done(map("trial", "map.ot"));
  const Outcome score = mapscore({"score", path("map.ot"), "--truth", path("tiny"), "--origin_m",
                                  "0.01", "0.02", "0.03", "--tidy"});
  expect_done(score);
  EXPECT_THAT(score.out, HasSubstr("crate,recall,1\n"));
}

TEST_F(TrialVerb, DamagedImagesAreOneLine) {
  expect_done(trial("trial"));
  for (const char* image : {"depth/000001.png", "label/000001.png"}) {
    const std::string bytes = bytes_of(path("trial") + "/" + image);
    fs::remove(path("trial") + "/" + image);
    write_text(path("trial") + "/" + image, bytes.substr(0, bytes.size() / 2));
    expect_refused(map("trial", "map.ot"), {image});
    fs::remove(path("trial") + "/" + image);
    expect_refused(map("trial", "map.ot"), {image, "missing"});
    write_text(path("trial") + "/" + image, bytes);
  }
  expect_done(map("trial", "map.ot"));
}

TEST_F(TrialVerb, ReadOnlyFolderIsRefusedAndAReadOnlyTrialIsMapped) {
  expect_done(trial("trial"));
  fs::permissions(path("trial"), fs::perms::owner_read | fs::perms::owner_exec);
  expect_done(map("trial", "map.ot"));
  fs::permissions(path("trial"), fs::perms::owner_all);
  if (geteuid() == 0) GTEST_SKIP() << "root writes everywhere";
  fs::create_directory(path("shut"));
  fs::permissions(path("shut"), fs::perms::owner_read | fs::perms::owner_exec);
  expect_refused(trial("shut/trial"), {"shut/trial", "cannot create"});
  fs::permissions(path("shut"), fs::perms::owner_all);
}

/// /dev/shm is a disk of its own on every Linux that CI knows.
TEST_F(TrialVerb, DiskWithoutTheRecordingGetsCopies) {
  const fs::path other = "/dev/shm/mapscore_trial_" + std::to_string(getpid());
  if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm";
  expect_done(mapscore({"trial", study(), "-o", other.string(), "-q"}));
  expect_done(trial("trial"));
  EXPECT_EQ(contents_of(other), contents_of(path("trial")));
  const Outcome mapped = mapscore({"map", other.string(), "-o", path("there.ot"), "-q"});
  fs::remove_all(other);
  expect_done(mapped);
  expect_done(map("trial", "here.ot"));
  EXPECT_EQ(bytes_of(path("there.ot")), bytes_of(path("here.ot")));
}

}  // namespace
}  // namespace mapscore::testing
