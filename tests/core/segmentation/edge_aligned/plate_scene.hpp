// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/segmentation/edge_aligned/edge_aligned.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace mapscore::testing {

/// 1 + index of the detection of each depth pixel, 0 for none.
inline cv::Mat1w label_depth(const std::vector<Detection>& detections, const cv::Mat1w& depth,
                             const Calibration& believed, const EdgeAligned& params) {
  return label_surfaces(Sight(believed, depth, detections), params).labels;
}

/// A rectangle at depth z, parallel to the image planes; metres in depth_optical.
struct Plate {
  double left, right, top, bottom, z;
  InstanceId instance;
};

inline constexpr double kWall_m = 3.0;

/// Plates before a wall, perhaps on a floor, seen by two cameras side by side.
class PlateScene {
 public:
  explicit PlateScene(std::vector<Plate> plates, double floor_y_m = 1e9, double wall_m = kWall_m)
      : plates_(std::move(plates)), floor_y_m_(floor_y_m), wall_m_(wall_m) {
    truth_.color = CameraModel::from_hfov(320, 240, 60 * std::numbers::pi / 180);
    truth_.depth = CameraModel::from_hfov(320, 240, 58.4 * std::numbers::pi / 180);
    truth_.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0, 0);
    for (const Plate& plate : plates_) {
      const auto id = static_cast<std::size_t>(plate.instance);
      while (table_.instances.size() <= id)
        table_.instances.push_back({static_cast<InstanceId>(table_.instances.size()), "thing", 1});
    }
    table_.classes.push_back({1, "thing", {}, true});
  }

  /// The same by another colour camera, which stands at `eye` in depth_optical.
  [[nodiscard]] PlateScene seen_by(const CameraModel& color, const Eigen::Vector3d& eye) const {
    PlateScene scene = *this;
    scene.truth_.color = color;
    scene.truth_.T_color_depth.translation() = -eye;
    return scene;
  }

  [[nodiscard]] const Calibration& truth() const { return truth_; }
  /// Believed calibration with the error E on the left.
  [[nodiscard]] Calibration misregistered(const Eigen::Vector3d& shift_m,
                                          const Eigen::Vector3d& turn_rad) const {
    Calibration believed = truth_;
    Pose error = Pose::Identity();
    error.linear() = exp_rotation(turn_rad);
    error.translation() = shift_m;
    believed.T_color_depth = error * truth_.T_color_depth;
    return believed;
  }

  [[nodiscard]] cv::Mat1w depth() const {
    cv::Mat1w image(240, 320);
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u)
        image(v, u) = cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre *
                                                       seen(truth_.depth, {0, 0, 0}, u, v).second);
    return image;
  }
  [[nodiscard]] cv::Mat1w depth_label() const { return label_of(truth_.depth, {0, 0, 0}); }
  [[nodiscard]] cv::Mat1w label() const {
    return label_of(truth_.color, -truth_.T_color_depth.translation());
  }
  [[nodiscard]] std::vector<Detection> detections() const { return detections_of(label(), table_); }
  [[nodiscard]] std::vector<Detection> detections(const cv::Mat1w& label) const {
    return detections_of(label, table_);
  }

 private:
  [[nodiscard]] std::pair<InstanceId, double> seen(const CameraModel& camera,
                                                   const Eigen::Vector3d& eye, int u, int v) const {
    const double fall = camera.back_project(u, v, 1.0).y();
    const double floor_z = fall > 0 ? (floor_y_m_ - eye.y()) / fall : 1e9;
    std::pair<InstanceId, double> nearest{0, std::min(wall_m_, floor_z)};
    for (const Plate& plate : plates_) {
      const Eigen::Vector3d p = eye + camera.back_project(u, v, plate.z);
      if (plate.z < nearest.second && p.x() >= plate.left && p.x() <= plate.right &&
          p.y() >= plate.top && p.y() <= plate.bottom)
        nearest = {plate.instance, plate.z};
    }
    return nearest;
  }
  [[nodiscard]] cv::Mat1w label_of(const CameraModel& camera, const Eigen::Vector3d& eye) const {
    cv::Mat1w image(camera.height_px, camera.width_px);
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u) image(v, u) = seen(camera, eye, u, v).first;
    return image;
  }

  std::vector<Plate> plates_;
  double floor_y_m_, wall_m_;
  Calibration truth_;
  ClassTable table_;
};

struct Agreement {
  double precision, recall;
};

/// Of depth pixels, all instances together; each must get its own label.
inline Agreement agreement(const cv::Mat1w& labels, const std::vector<Detection>& detections,
                           const cv::Mat1w& truth) {
  double predicted = 0, right = 0, wanted = 0;
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const int label = labels(v, u);
      const int instance =
          label == 0 ? 0 : detections[static_cast<std::size_t>(label - 1)].instance;
      predicted += instance != 0;
      wanted += truth(v, u) != 0;
      right += instance != 0 && instance == truth(v, u);
    }
  return {right / std::max(predicted, 1.0), right / std::max(wanted, 1.0)};
}

}  // namespace mapscore::testing
