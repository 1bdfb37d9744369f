// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segment.hpp"

#include <opencv2/core.hpp>

#include <vector>

namespace mapscore {

/// Every point of the mask: what most systems do.
struct Direct {
  static constexpr std::string_view kKind = "direct";
  static constexpr std::string_view kMeaning = "every point of the mask";

  static void fields(auto&, auto&&) {}
  /// As `segment` of segmentation.hpp, which fills in class, instance, score and box.
  [[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                                double voxel_m, bool with_voxels) const;
  bool operator==(const Direct&) const = default;
};

/// Points behind the pixels of a mask that have one, in row-major order of the pixels. `mask` is of
/// the size of `box`, which lies within the colour image.
[[nodiscard]] std::vector<Eigen::Vector3d> points_behind(const cv::Mat1b& mask, const PixelBox& box,
                                                         const RegisteredCloud& cloud);

/// The segment that consists of these points.
[[nodiscard]] Segment segment_of(std::vector<Eigen::Vector3d> points, double voxel_m,
                                 bool with_voxels);

/// The segment of these pixels of a detection.
[[nodiscard]] Segment segment_of(const cv::Mat1b& mask, const PixelBox& box,
                                 const RegisteredCloud& cloud, double voxel_m, bool with_voxels);

}  // namespace mapscore
