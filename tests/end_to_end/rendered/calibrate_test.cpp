// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/camera.hpp"
#include "eval/foreign/camera_file.hpp"
#include "eval/recording/recording.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <sstream>

// `mapscore calibrate` by the built program, on a drive through the apartment of the demo.

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kDemo = std::string(MAPSCORE_SOURCE_DIR) + "/configs/demo.yaml";
/// A small camera, so that a test takes seconds.
const std::vector<std::string> kSmall{"--set", "cameras.width_px=320", "--set",
                                      "cameras.height_px=240"};

std::vector<std::string> joined(std::vector<std::string> words,
                                const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class CalibrateVerb : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_.emplace();
    expect_done(mapscore(joined({"record", kDemo, "-o", path("recording"), "-q", "--set",
                                 "trajectory.depth_frames_per_s=14"},
                                kSmall)));
  }
  static void TearDownTestSuite() { shared_.reset(); }

  [[nodiscard]] static std::string path(const std::string& name) {
    return (shared_->path() / name).string();
  }
  [[nodiscard]] static Calibration truth() {
    return eval::Recording::open(path("recording")).info().calibration;
  }
  /// Cameras whose T_color_depth is off by a shift (m) and a turn (rad) about both image axes.
  [[nodiscard]] static std::string wrong_cameras(double shift_m, double turn_rad) {
    eval::BelievedCameras wrong{truth(), 0};
    Pose error = Pose::Identity();
    error.linear() = exp_rotation({turn_rad, -turn_rad, 0});
    error.translation() = Eigen::Vector3d(shift_m, shift_m, 0);
    wrong.calibration.T_color_depth = error * wrong.calibration.T_color_depth;
    write_text(path("wrong.yaml"), eval::cameras_file_text(wrong));
    return path("wrong.yaml");
  }
  [[nodiscard]] static Outcome calibrate(const std::string& folder, const std::string& output,
                                         const std::vector<std::string>& more = {}) {
    return mapscore(joined({"calibrate", path(folder), "-o", path(output), "-q"}, more));
  }
  static void expect_near_truth(const std::string& file, double most_m, double most_deg) {
    const Pose error =
        eval::read_cameras(path(file)).calibration.T_color_depth * truth().T_color_depth.inverse();
    EXPECT_LT(error.translation().norm(), most_m);
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle() * 180 / std::numbers::pi, most_deg);
  }

 private:
  static std::optional<TemporaryFolder> shared_;
};

std::optional<TemporaryFolder> CalibrateVerb::shared_;

TEST_F(CalibrateVerb, FindsTheTruthFromAWrongStartAndMapsWithIt) {
  const Outcome outcome =
      calibrate("recording", "found.yaml",
                {"--start", wrong_cameras(0.02, 0.012), "--picture", path("found.png")});
  expect_done(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("calibrated: "));
  EXPECT_THAT(outcome.out, HasSubstr("known least: "));
  EXPECT_GT(bytes_of(path("found.png")).size(), 1000U);
  expect_near_truth("found.yaml", 0.003, 0.15);

  const auto f1 = [&](const std::string& map, const std::vector<std::string>& cameras) {
    expect_done(mapscore(joined(
        {"map", path("recording"), "-o", path(map), "-q", "--segmentation", "direct"}, cameras)));
    const Outcome score = mapscore({"score", path(map), "--truth", path("recording"), "--tidy"});
    expect_done(score);
    const std::size_t at = score.out.find("pooled,f1,");
    return at == std::string::npos ? -1.0 : std::stod(score.out.substr(at + 10));
  };
  const double true_f1 = f1("true.ot", {});
  EXPECT_LT(f1("wrong.ot", {"--calibration", path("wrong.yaml")}), true_f1 - 0.05);
  EXPECT_NEAR(f1("found.ot", {"--calibration", path("found.yaml")}), true_f1, 0.01);
}

TEST_F(CalibrateVerb, SameFramesSameBytes) {
  const std::string start = wrong_cameras(0.01, 0.005);
  expect_done(calibrate("recording", "a.yaml", {"--start", start}));
  expect_done(calibrate("recording", "b.yaml", {"--start", start}));
  EXPECT_EQ(bytes_of(path("a.yaml")), bytes_of(path("b.yaml")));
}

TEST_F(CalibrateVerb, TimeOffsetIsFoundAndMappedWith) {
  fs::copy(path("recording"), path("late"), fs::copy_options::recursive);
  std::istringstream lines(bytes_of(path("recording/color.txt")));
  std::ostringstream shifted;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    double stamp_s = 0;
    std::string image;
    words >> stamp_s >> image;
    shifted << std::fixed << stamp_s - 1.0 / 14 << " label" << image.substr(image.find('/'))
            << '\n';
  }
  write_text(path("late/label.txt"), shifted.str());
  fs::remove(path("late/hashes.txt"));
  expect_done(calibrate("late", "late.yaml", {"--time_offset"}));
  EXPECT_NEAR(eval::read_cameras(path("late.yaml")).time_offset_s, 1.0 / 14, 0.005);
  const std::vector<std::string> direct{"--segmentation", "direct"};
  expect_done(mapscore(
      joined({"map", path("late"), "-o", path("late.ot"), "-q", "--calibration", path("late.yaml")},
             direct)));
}

TEST_F(CalibrateVerb, TrialOfAMisregistrationIsCalibratedAndMapped) {
  expect_done(mapscore(joined({"trial", kDemo, "-o", path("trial"), "-q", "--set",
                               "faults.misregistration.magnitude_m=0.02", "--set", "sweep={}"},
                              kSmall)));
  expect_done(calibrate("trial", "of_trial.yaml"));
  expect_near_truth("of_trial.yaml", 0.003, 0.15);
  expect_done(mapscore({"map", path("trial"), "-o", path("trial.ot"), "-q", "--calibration",
                        path("of_trial.yaml")}));
  expect_refused(calibrate("trial", "timed.yaml", {"--time_offset"}), {"--time_offset", "trial"});
  expect_refused(calibrate("trial", "of_trial.yaml", {"--detect", "chair"}), {"--detect"});
}

TEST_F(CalibrateVerb, TooLittleInViewIsRefusedAndNothingWritten) {
  const Outcome outcome =
      calibrate("recording", "none.yaml", {"--frames", "0", "--detect", "fridge"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("undetermined: "));
  EXPECT_THAT(outcome.err, HasSubstr("is not written"));
  EXPECT_FALSE(fs::exists(path("none.yaml")));

  const std::string earlier = "color: {}\nestimate: {}\n";
  write_text(path("earlier.yaml"), earlier);
  EXPECT_THAT(calibrate("recording", "earlier.yaml", {"--frames", "0", "--detect", "fridge"}).err,
              HasSubstr("of an earlier run"));
  EXPECT_EQ(bytes_of(path("earlier.yaml")), earlier);
}

TEST_F(CalibrateVerb, PixelsThatAllHaveAClassTellItToo) {
  expect_done(calibrate("recording", "dense.yaml",
                        {"--detect", "all", "--start", wrong_cameras(0.01, 0.01)}));
  expect_near_truth("dense.yaml", 0.003, 0.05);
}

TEST_F(CalibrateVerb, WhatIsReadIsNotWrittenOver) {
  const std::string start = wrong_cameras(0.01, 0.005);
  expect_refused(mapscore({"calibrate", path("recording"), "-o", start}),
                 {"-o", "is no calibration of an earlier run"});
  expect_refused(calibrate("recording", "recording/recording.yaml"), {"FOLDER reads this file"});
  expect_refused(
      calibrate("recording", "x.yaml", {"--picture", path("recording/label/000000.png")}),
      {"--picture", "may be an image of the recording"});
  expect_refused(
      calibrate("recording/", "x.yaml", {"--picture", path("recording/label/000000.png")}),
      {"--picture", "may be an image of the recording"});
  fs::copy_file(start, path("start.png"));
  expect_refused(calibrate("recording", "x.yaml",
                           {"--start", path("start.png"), "--picture", path("start.png")}),
                 {"--picture", "--start reads this file"});
  write_text(path("empty.yaml"), "");
  expect_refused(calibrate("recording", "empty.yaml"), {"-o", "is no calibration"});
  fs::create_directory(path("elsewhere"));
  fs::copy(path("recording"), path("linked"), fs::copy_options::recursive);
  fs::rename(path("linked/label"), path("elsewhere/label"));
  fs::create_directory_symlink(path("elsewhere/label"), path("linked/label"));
  expect_refused(
      calibrate("linked", "x.yaml", {"--follow", "--picture", path("elsewhere/label/000000.png")}),
      {"--picture", "FOLDER reads this file"});
  expect_done(calibrate("recording", "first.yaml"));
  expect_refused(calibrate("recording", "first.yaml", {"--start", path("first.yaml")}),
                 {"-o", "--start reads this file"});
}

TEST_F(CalibrateVerb, AStartMayNameTheColourCameraAlone) {
  const auto& [width, height, fx, fy, cx, cy] = truth().color;
  write_text(
      path("colour.yaml"),
      fmt::format("color: {{fx_px: {}, fy_px: {}, cx_px: {}, cy_px: {}}}\n", fx, fy, cx, cy));
  expect_done(calibrate("recording", "own.yaml"));
  expect_done(calibrate("recording", "colour_alone.yaml", {"--start", path("colour.yaml")}));
  EXPECT_EQ(bytes_of(path("own.yaml")), bytes_of(path("colour_alone.yaml")));
}

TEST_F(CalibrateVerb, BadInputIsRefused) {
  expect_refused(calibrate("nowhere", "x.yaml"), {"no such folder"});
  expect_refused(calibrate("recording", "x.txt"), {"-o", ".yaml"});
  expect_refused(calibrate("recording", "x.yaml", {"--frames", "7000"}), {"7000"});
  expect_refused(calibrate("recording", "x.yaml", {"--search_deg", "90"}), {"search_deg"});
  write_text(path("far.yaml"), "color: {fx_px: 1e308, fy_px: 280, cx_px: 160, cy_px: 120}\n");
  expect_refused(calibrate("recording", "x.yaml", {"--start", path("far.yaml")}),
                 {"a focal length of 1e+308 px"});
  write_text(path("apart.yaml"),
             "color: {fx_px: 280, fy_px: 280, cx_px: 160, cy_px: 120}\n"
             "T_color_depth: [20, 0, 0, 0, 0, 0, 1]\n");
  expect_refused(calibrate("recording", "x.yaml", {"--start", path("apart.yaml")}),
                 {"apart.yaml", "T_color_depth", "20.000000 m away"});
  write_text(path("bad.yaml"), "color: {fx_px: 0}\n");
  expect_refused(calibrate("recording", "x.yaml", {"--start", path("bad.yaml")}), {"fx_px"});
}

TEST_F(CalibrateVerb, StudyTakesAnEstimateAsItsCalibration) {
  expect_done(mapscore(joined(
      {"sweep", kDemo, "-o", path("results"), "-q", "--set", "seeds=1", "--set",
       "sweep={faults.misregistration.magnitude_m: [0.02], calibration: [believed, estimated]}"},
      kSmall)));
  const Outcome table = mapscore({"table", path("results"), "--tidy"});
  expect_done(table);
  const auto figure = [&](const std::string& calibration, const std::string& metric) {
    std::istringstream lines(table.out);
    for (std::string line; std::getline(lines, line);)
      if (line.find(calibration) != std::string::npos && line.find("direct") != std::string::npos &&
          line.find(metric) != std::string::npos)
        return std::stod(line.substr(line.rfind(',') + 1));
    ADD_FAILURE() << metric << " of " << calibration << " is missing";
    return 0.0;
  };
  EXPECT_GT(figure("estimated", ",pooled,f1,"), figure("believed", ",pooled,f1,") + 0.1);
  EXPECT_EQ(figure("estimated", ",calibrations,"), 1.0);
  EXPECT_EQ(figure("estimated", ",calibrations_refused,"), 0.0);
  EXPECT_LT(figure("estimated", ",calibration_error_um,"), 3000.0);
}

}  // namespace
}  // namespace mapscore::testing
