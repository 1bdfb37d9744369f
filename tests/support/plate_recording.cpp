// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/support/plate_recording.hpp"

#include "eval/recording/recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <cmath>

namespace mapscore::testing {
namespace {

constexpr double kPlate_m = 1.01, kWall_m = 1.51;
constexpr InstanceId kPlate = 1, kWall = 2;
const cv::Rect kMask(2, 1, 4, 4);

eval::RecordingInfo plate_info() {
  eval::RecordingInfo info;
  CameraModel camera;
  camera.width_px = 8;
  camera.height_px = 6;
  camera.fx_px = camera.fy_px = kPlate_m / 0.05;  // a pixel is 5 cm wide on the plate
  camera.cx_px = 3.5;
  camera.cy_px = 2.5;
  info.calibration.color = info.calibration.depth = camera;
  info.calibration.T_base_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  info.calibration.T_base_depth.translation() = Eigen::Vector3d(0, 0, 0.15);
  info.color_rate_hz = info.depth_rate_hz = 1.0;
  info.table.classes.push_back({1, "plate", {255, 0, 0}, true});
  info.table.classes.push_back({2, "wall", {0, 0, 255}, false});
  info.table.instances.push_back({kPlate, "plate_1", 1});
  info.table.instances.push_back({kWall, "wall_1", 2});
  info.scene = "plate.xml";
  info.frame_count = 1;
  return info;
}

Shape facing_robot(const char* name, InstanceId instance, double x_m, double half_m) {
  Shape shape;
  shape.kind = ShapeKind::plane;
  shape.name = name;
  shape.instance = instance;
  shape.T_world_shape.linear() << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  shape.T_world_shape.translation() = Eigen::Vector3d(x_m, 0, 0.15);
  shape.size = Eigen::Vector3d(half_m, half_m, 0);
  return shape;
}

std::uint16_t units(double z_m) {
  return static_cast<std::uint16_t>(std::lround(z_m * kDepthUnitsPerMetre));
}

Frame plate_frame() {
  Frame frame;
  frame.color = cv::Mat3b(6, 8, cv::Vec3b(0, 0, 0));
  frame.label = cv::Mat1w(6, 8, kWall);
  frame.depth = cv::Mat1w(6, 8, units(kWall_m));
  frame.label(kMask).setTo(kPlate);
  frame.depth(kMask).setTo(units(kPlate_m));
  frame.depth_label = frame.label.clone();
  return frame;
}

}  // namespace

void write_plate_recording(const std::filesystem::path& folder) {
  eval::RecordingWriter writer(folder, plate_info());
  write_frame(writer, plate_frame());
  writer.write_shapes(
      {facing_robot("plate", kPlate, kPlate_m, 0.1), facing_robot("wall", kWall, kWall_m, 1.0)});
  writer.finish();
}

}  // namespace mapscore::testing
