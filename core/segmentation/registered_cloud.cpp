// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/registered_cloud.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace mapscore {

RegisteredCloud::RegisteredCloud(cv::Mat1w depth, const CameraModel& depth_camera, cv::Mat1i source)
    : depth_(std::move(depth)), rays_(depth_camera), source_(std::move(source)) {}

void RegisteredCloud::append_points(int u, int v, std::span<const std::uint8_t> inside,
                                    std::vector<Eigen::Vector3d>& points) const {
  const int* sources = source_[v] + u;
  std::array<int, 256> found;  // a branch for each pixel would cost more than its point
  for (std::size_t next = 0; next < inside.size();) {
    const std::size_t end = std::min(next + found.size(), inside.size());
    std::size_t count = 0;
    for (; next < end; ++next) {
      found[count] = sources[next];
      count += static_cast<std::size_t>((inside[next] != 0) & (sources[next] != kNone));
    }
    append_points(std::span(found).first(count), points);
  }
}

void RegisteredCloud::append_points(std::span<const int> depth_pixels,
                                    std::vector<Eigen::Vector3d>& points) const {
  const double *ray_x = rays_.x().data(), *ray_y = rays_.y().data();
  const int columns = depth_.cols;
  int row = 0, first = 0;  // of the depth image; neighbours mostly see the same one
  const std::uint16_t* depth = depth_[row];
  for (const int pixel : depth_pixels) {
    if (pixel < first || pixel - first >= columns) {
      row = pixel / columns;
      first = row * columns;
      depth = depth_[row];
    }
    const double z = depth[pixel - first] / kDepthUnitsPerMetre;
    points.emplace_back(z * ray_x[pixel - first], z * ray_y[row], z);
  }
}

}  // namespace mapscore
