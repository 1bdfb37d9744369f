// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// A segmentation of one's own: of each mask the points whose depth is near the median of all.

#include <core/segmentation/occupied_centres.hpp>
#include <core/segmentation/segmentation_plug_in.hpp>

#include <algorithm>
#include <cmath>

namespace {

using mapscore::Field, mapscore::Segment;

struct DepthBand {
  static constexpr std::string_view kKind = "depth_band";
  static constexpr std::string_view kMeaning = "points of the mask near its median depth";
  double band_m = 0.3;

  static void fields(auto& s, auto&& visit) {
    visit(s.band_m, Field{"band_m", "largest distance from the median depth", mapscore::above(0)});
  }

  Segment segment(const mapscore::Detection& detection, const mapscore::RegisteredCloud& cloud,
                  double voxel_m, bool with_voxels) const {
    const Segment all = mapscore::Direct{}.segment(detection, cloud, voxel_m, false);
    if (all.points.empty()) return all;
    std::vector<double> depths;
    for (const Eigen::Vector3d& point : all.points) depths.push_back(point.z());
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    Segment near;
    for (const Eigen::Vector3d& point : all.points)
      if (std::abs(point.z() - *middle) <= band_m) near.points.push_back(point);
    if (with_voxels) near.voxel_centres = mapscore::occupied_centres(near.points, voxel_m);
    return near;
  }

  bool operator==(const DepthBand&) const = default;
};

const mapscore::SegmentationPlugIn<DepthBand> plug_in;

}  // namespace
