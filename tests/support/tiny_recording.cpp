// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/support/tiny_recording.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace mapscore::testing {
namespace {

constexpr int kFrames = 4;
constexpr double kRateHz = 2.0;
constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Ray parameter t >= 0 of the first point origin + t * direction on the box |p| <= half; kNoHit
/// without.
double hit_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               const Eigen::Vector3d& half) {
  double enter = 0.0, leave = kNoHit;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (std::abs(origin[axis]) > half[axis]) return kNoHit;
      continue;
    }
    const double a = (-half[axis] - origin[axis]) / direction[axis];
    const double b = (half[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kNoHit;
}

/// The same for the rectangle z = 0, |x| <= half.x, |y| <= half.y; both sides are seen.
double hit_plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                 const Eigen::Vector3d& half) {
  if (direction.z() == 0.0) return kNoHit;
  const double t = -origin.z() / direction.z();
  const Eigen::Vector3d p = origin + t * direction;
  const bool inside = std::abs(p.x()) <= half.x() && std::abs(p.y()) <= half.y();
  return t >= 0.0 && inside ? t : kNoHit;
}

double hit(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Pose T_shape_world = shape.T_world_shape.inverse();
  const Eigen::Vector3d o = T_shape_world * origin;
  const Eigen::Vector3d d = T_shape_world.linear() * direction;
  return shape.kind == ShapeKind::plane ? hit_plane(o, d, shape.size) : hit_box(o, d, shape.size);
}

/// Robot pose of frame i: it drives sideways and turns towards the crate.
Pose base_pose(int index) {
  return planar_pose(0.03 * index, -0.15 + 0.1 * index, 0.04 - 0.03 * index);
}

Shape shape_of(ShapeKind kind, InstanceId instance, const char* name,
               const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
               const Eigen::Vector3d& size) {
  Shape shape;
  shape.kind = kind;
  shape.instance = instance;
  shape.name = name;
  shape.T_world_shape.linear() = rotation;
  shape.T_world_shape.translation() = position;
  shape.size = size;
  return shape;
}

/// The colour of each pixel's class, so that the colour image shows what the label image says.
cv::Mat3b paint(const cv::Mat1w& label, const ClassTable& table) {
  cv::Mat3b image(label.size());
  for (int v = 0; v < label.rows; ++v)
    for (int u = 0; u < label.cols; ++u) {
      const Colour colour = table.classes[table.class_of(label(v, u))].colour;
      image(v, u) = cv::Vec3b(colour.b, colour.g, colour.r);
    }
  return image;
}

}  // namespace

RayCast ray_cast(const std::vector<Shape>& shapes, const CameraModel& camera,
                 const Pose& T_world_camera, double range_min_m, double range_max_m) {
  RayCast seen{cv::Mat1w::zeros(camera.height_px, camera.width_px),
               cv::Mat1w::zeros(camera.height_px, camera.width_px)};
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      // A direction with z = 1 in the optical frame makes the ray parameter the planar depth.
      const Eigen::Vector3d direction = T_world_camera.linear() * camera.back_project(u, v, 1.0);
      double z_m = kNoHit;
      for (const Shape& shape : shapes) {
        const double t = hit(shape, T_world_camera.translation(), direction);
        if (t >= z_m) continue;
        z_m = t;
        seen.label(v, u) = shape.instance;
      }
      if (z_m < range_min_m || z_m > range_max_m) continue;
      seen.depth(v, u) = static_cast<std::uint16_t>(std::lround(z_m * kDepthUnitsPerMetre));
    }
  return seen;
}

eval::RecordingInfo tiny_info() {
  eval::RecordingInfo info;
  const CameraModel camera = CameraModel::from_hfov(64, 48, 60.0 * std::numbers::pi / 180.0);
  info.calibration.color = info.calibration.depth = camera;
  info.calibration.T_color_depth.translation() = Eigen::Vector3d(0.025, 0.0, 0.0);
  info.calibration.T_base_depth.linear() << 0, 0, 1, -1, 0, 0, 0, -1,
      0;  // optical -> x forward, z up
  info.calibration.T_base_depth.translation() = Eigen::Vector3d(0.1, 0.0, 0.6);
  info.color_rate_hz = info.depth_rate_hz = kRateHz;
  info.table.classes.push_back({1, "crate", {255, 0, 0}, true});
  info.table.classes.push_back({2, "wall", {0, 0, 255}, false});
  info.table.instances.push_back({1, "crate_1", 1});
  info.table.instances.push_back({2, "wall_1", 2});
  info.scene = "tiny.xml";
  info.scene_hash = "00000000000000000000000000000000";
  info.seed = 7;
  info.frame_count = kFrames;
  return info;
}

std::vector<Shape> tiny_shapes() {
  Eigen::Matrix3d facing_robot;  // the plane's normal (its z) along -x of the world, its y up
  facing_robot << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  return {
      shape_of(ShapeKind::box, 1, "crate_geom", {1.703, 0.107, 0.453},
               exp_rotation(0.3 * Eigen::Vector3d::UnitZ()), {0.2, 0.15, 0.25}),
      shape_of(ShapeKind::plane, 2, "wall_geom", {3.011, 0.0, 0.9}, facing_robot, {1.5, 0.9, 0.0})};
}

std::vector<Frame> tiny_frames() {
  const eval::RecordingInfo info = tiny_info();
  const Calibration& calibration = info.calibration;
  const std::vector<Shape> shapes = tiny_shapes();
  std::vector<Frame> frames(kFrames);
  for (int index = 0; index < kFrames; ++index) {
    Frame& frame = frames[static_cast<std::size_t>(index)];
    frame.index = index;
    frame.stamp_s = index / kRateHz;
    frame.T_world_base = base_pose(index);
    const Pose T_world_depth = frame.T_world_base * calibration.T_base_depth;
    const Pose T_world_color = T_world_depth * calibration.T_color_depth.inverse();
    const RayCast depth_view = ray_cast(shapes, calibration.depth, T_world_depth,
                                        calibration.range_min_m, calibration.range_max_m);
    frame.depth = depth_view.depth;
    frame.depth_label = depth_view.label;
    frame.label = ray_cast(shapes, calibration.color, T_world_color, 0.0, kNoHit).label;
    frame.color = paint(frame.label, info.table);
  }
  return frames;
}

void write_frame(eval::RecordingWriter& writer, const Frame& frame) {
  Frame numbered = frame;
  numbered.depth_index = frame.index;
  writer.write_color(numbered);
  writer.write_depth(numbered);
}

void write_tiny_recording(const std::filesystem::path& folder) {
  eval::RecordingWriter writer(folder, tiny_info());
  for (const Frame& frame : tiny_frames()) write_frame(writer, frame);
  writer.write_shapes(tiny_shapes());
  writer.finish();
}

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count{0};
  const std::string name = "mapscore_test_" + std::to_string(std::random_device{}()) + "_" +
                           std::to_string(count.fetch_add(1));
  path_ = std::filesystem::temp_directory_path() / name;
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace mapscore::testing
