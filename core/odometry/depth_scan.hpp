// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/parameters.hpp"

#include <opencv2/core.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mapscore {

/// How a depth image becomes the points that odometry matches, and how far it trusts them: standard
/// deviation of a pixel along the view sigma_base_m + sigma_growth_per_m (z - 0.4 m)^2 (C. V.
/// Nguyen, S. Izadi, D. Lovell, 2012), together with steps of disparity_step_per_m z^2 (K.
/// Khoshelham, S. O. Elberink, 2012). The defaults are those of an Astra, but for the step: an
/// Astra's of 0.0029 is common to all pixels of a surface and does not average out.
struct DepthSampling {
  int points_across = 80;       ///< of images that are matched
  int map_points_across = 160;  ///< of key frames, as they enter the map; see of_map
  double range_max_m = 8;
  double sigma_base_m = 0.0012, sigma_growth_per_m = 0.0019, disparity_step_per_m = 0.008;

  static void fields(auto& s, auto&& visit) {
    visit(s.points_across,
          Field{"points_across", "points in a row of an image that is matched", {8, 4096}});
    visit(s.map_points_across, Field{"map_points_across",
                                     "points in a row of a key frame as it enters the map",
                                     {8, 4096}});
    visit(s.range_max_m, Field{"range_max_m", "depth beyond it is not matched", above(0, 100)});
    visit(s.sigma_base_m,
          Field{"sigma_base_m", "believed standard deviation of depth at 0.4 m", above(0, 1)});
    visit(s.sigma_growth_per_m,
          Field{"sigma_growth_per_m", "its believed growth with (z - 0.4 m)^2", {0, 1}});
    visit(s.disparity_step_per_m,
          Field{"disparity_step_per_m", "believed step of depth over z^2", {0, 1}});
  }
  /// That of a key frame as it enters the map. Its errors stay there and move all that is matched
  /// with them, where those of one match average out: so it takes more points.
  [[nodiscard]] DepthSampling of_map() const {
    DepthSampling dense = *this;
    dense.points_across = map_points_across;
    return dense;
  }
  bool operator==(const DepthSampling&) const = default;
};

/// Points of one depth image in the axes of base_footprint (metres), with unit normals that look
/// towards the camera, and standard deviations.
struct DepthScan {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<double> sigma_m;

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The mean points of small blocks of pixels, evenly over the image, each a 160th of its width.
/// Blocks across an edge of depth, where
/// pixels fly, and beside one give none. Normals are those of the blocks around. `depth`: planar z
/// in units of 1 / kDepthUnitsPerMetre, 0 = none, of the believed depth camera. Throws Error when
/// the image is not of the camera's size. Thread-safe.
[[nodiscard]] DepthScan scan_of(const cv::Mat1w& depth, const Calibration& believed,
                                const DepthSampling& sampling);

/// Indices of the points on upright surfaces, whose normals rise by less than 0.7, of a base at
/// this pose: a floor fixes none of x, y and yaw, these do. Thread-safe.
[[nodiscard]] std::vector<std::size_t> upright_points(const DepthScan& scan,
                                                      const Pose& T_map_base);

}  // namespace mapscore
