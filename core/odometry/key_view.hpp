// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/odometry/local_map.hpp"

#include <opencv2/core.hpp>

#include <optional>
#include <vector>

namespace mapscore {

/// The pixel that a point in the depth camera's axes falls on; none outside of its view and range.
[[nodiscard]] std::optional<cv::Point> pixel_in_view(const Eigen::Vector3d& p,
                                                     const Calibration& believed);

/// Share of the upright points of an earlier scan that an image sees through, of those where it
/// shows anything: all that it shows within 2 pixels is more than 5 % farther, since silhouettes
/// are not sharp. Where they stood is nothing now, or one of the poses is wrong. 0 of fewer than 50
/// points. `T_map_image`: of the image's base. Thread-safe.
[[nodiscard]] double seen_through(const cv::Mat1w& depth, const Pose& T_map_image,
                                  const DepthScan& scan, const Pose& T_map_scan,
                                  const Calibration& believed);

/// What a key frame showed, to tell whether a later match can be right: any floor fits any other,
/// upright surfaces do not. Const members are safe from several threads.
class KeyView {
 public:
  KeyView() = default;
  /// `upright`: what the map knows of the upright points of the key frame's own `scan`, once they
  /// are in it.
  KeyView(const cv::Mat1w& depth, const DepthScan& scan, const std::vector<UprightPoint>& upright,
          const Calibration& believed);

  [[nodiscard]] const cv::Mat1w& depth() const { return depth_; }

  /// Whether of the scan's upright points less than 0.3 of those lie on planes that should. A point
  /// that the key frame must have shown should as often as the key frame's own: those that it had
  /// in that part of its image where the point lies on what it saw, within 5 %; all of them where
  /// it stands before that. Never where less than 0.3 of all should. `T_key_base`: of the scan's
  /// base in the key frame's.
  [[nodiscard]] bool misses(const DepthScan& scan, const ScanMatch& match,
                            const Calibration& believed, const Pose& T_key_base) const;

 private:
  cv::Mat1w depth_;
  double on_plane_share_ = 0.0;  ///< of all its upright points
  int cell_px_ = 1;
  cv::Mat1f local_share_;  ///< of those in each cell of its image, cell_px_ wide
};

}  // namespace mapscore
