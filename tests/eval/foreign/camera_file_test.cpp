// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/camera_file.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

class CameraFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "cameras.yaml";
    write_file(path, text);
    return path.string();
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(CameraFile, ReadsBackWhatWasWritten) {
  BelievedCameras written{testing::tiny_info().calibration, -0.0953};
  written.calibration.T_color_depth.linear() =
      exp_rotation({0.01, -0.02, 0.03}) * written.calibration.T_color_depth.linear();
  const BelievedCameras read = read_cameras(file(cameras_file_text(written)));
  EXPECT_EQ(read.time_offset_s, -0.0953);
  EXPECT_TRUE(read.calibration.T_color_depth.isApprox(written.calibration.T_color_depth, 1e-14));
  EXPECT_TRUE(read.calibration.T_base_depth.isApprox(written.calibration.T_base_depth, 1e-14));
  EXPECT_EQ(read.calibration.color.fx_px, written.calibration.color.fx_px);
  EXPECT_EQ(read.calibration.depth.cy_px, written.calibration.depth.cy_px);
  EXPECT_EQ(read.calibration.range_max_m, written.calibration.range_max_m);
}

TEST_F(CameraFile, FourNumbersAreDepthThatIsRegisteredToColour) {
  const BelievedCameras cameras = read_cameras("500,510,320,240");
  EXPECT_EQ(cameras.calibration.color, cameras.calibration.depth);
  EXPECT_EQ(cameras.calibration.depth.fy_px, 510);
  EXPECT_EQ(cameras.time_offset_s, 0);
  testing::expect_error("cameras: '500,510,320' is not fx,fy,cx,cy",
                        [] { (void)read_cameras("500,510,320"); });
  testing::expect_error("cameras: '500,510,nan,240' is not fx,fy,cx,cy",
                        [] { (void)read_cameras("500,510,nan,240"); });
}

TEST_F(CameraFile, WhatIsLeftOutIsAsTheFolderSays) {
  const Calibration own = testing::tiny_info().calibration;
  for (const std::string& text :
       {file("color: {fx_px: 500, fy_px: 510, cx_px: 320, cy_px: 240}\nrange_max_m: 5\n"),
        std::string("500,510,320,240")}) {
    const Calibration read = read_cameras(text, own).calibration;
    EXPECT_EQ(read.color.fy_px, 510) << text;
    EXPECT_EQ(read.depth, own.depth) << text;
    EXPECT_TRUE(read.T_color_depth.isApprox(own.T_color_depth)) << text;
    EXPECT_TRUE(read.T_base_depth.isApprox(own.T_base_depth)) << text;
    EXPECT_EQ(read.range_min_m, own.range_min_m) << text;
  }
  EXPECT_EQ(read_cameras(file("range_max_m: 5\n"), own).calibration.color, own.color);
  testing::expect_error("'color' is missing",
                        [&] { (void)read_cameras(file("range_max_m: 5\n")); });
  EXPECT_EQ(read_cameras(file("color: {fx_px: 500, fy_px: 510, cx_px: 320, cy_px: 240}\n"
                              "range_max_m: 5\n"),
                         own)
                .calibration.range_max_m,
            5);
}

/// A recording may have any range, and what `calibrate` writes of it is read again.
TEST_F(CameraFile, RangesOfTheFolderAreTakenAsTheyAre) {
  Calibration own = testing::tiny_info().calibration;
  own.range_max_m = 200;
  const std::string color = "color: {fx_px: 500, fy_px: 500, cx_px: 320, cy_px: 240}\n";
  EXPECT_EQ(read_cameras(file(color), own).calibration.range_max_m, 200);
  EXPECT_EQ(read_cameras(file(cameras_file_text({own, 0}))).calibration.range_max_m, 200);
  testing::expect_error(":2: range_min_m: expected 0 <= range_min_m < range_max_m",
                        [&] { (void)read_cameras(file(color + "range_min_m: 201\n"), own); });
}

TEST_F(CameraFile, WhatAnEstimateSaysOfItselfIsLetThrough) {
  const std::string color = "color: {fx_px: 500, fy_px: 500, cx_px: 320, cy_px: 240}\n";
  EXPECT_NO_THROW((void)read_cameras(file(color + "estimate: {verdict: calibrated}\n")));
  testing::expect_error("estimates", [&] { (void)read_cameras(file(color + "estimates: {}\n")); });
  testing::expect_error("time_offset_s: expected seconds from -10 to 10",
                        [&] { (void)read_cameras(file(color + "time_offset_s: 95\n")); });
}

}  // namespace
}  // namespace mapscore::eval
