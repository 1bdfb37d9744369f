// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/coarse_outlines.hpp"

#include "core/wide_vectors.hpp"

namespace mapscore {
CoarseOutlines::CoarseOutlines(const EdgeColumns& edges, const OutlineField& field,
                               const Projection& project)
    : edges_(edges), field_(field), project_(project), cells_(edges.x.size()) {
  for (const cv::Mat1b& map : field.coarse) maps_.insert(maps_.end(), map[0], map[0] + map.total());
  maps_.push_back(0);
  for (const std::uint8_t way : edges.way)
    map_.push_back(way * static_cast<int>(field.coarse[0].total()));
}

MAPSCORE_WIDE_VECTORS
void CoarseOutlines::find_cells(const Eigen::Matrix3f& R, const Eigen::Vector3f& t) {
  const int count = static_cast<int>(cells_.size()), columns = field_.coarse[0].cols;
  const int beyond = static_cast<int>(maps_.size()) - 1;
  const float *xs = edges_.x.data(), *ys = edges_.y.data(), *zs = edges_.z.data();
  const int* maps = map_.data();
  int* const cells = cells_.data();
  const float right = static_cast<float>(columns),
              bottom = static_cast<float>(field_.coarse[0].rows);
  const float fx = project_.fx, fy = project_.fy, cx = project_.cx, cy = project_.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = t.x(), ty = t.y(), tz = t.z();
  constexpr float kCells = 1.0F / OutlineField::kCell_px;
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const float x = xs[n], y = ys[n], z = zs[n];
    const float X = xx * x + xy * y + xz * z + tx;
    const float Y = yx * x + yy * y + yz * z + ty;
    const float Z = zx * x + zy * y + zz * z + tz;
    const float u = (fx * X / Z + cx) * kCells, v = (fy * Y / Z + cy) * kCells;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(within ? u : 0.0F);
    const int row = static_cast<int>(within ? v : 0.0F);
    cells[n] = within ? maps[n] + row * columns + column : beyond;
  }
}

float CoarseOutlines::score(const Eigen::Matrix3f& R, const Eigen::Vector3f& t) {
  find_cells(R, t);
  float sum = 0;
  for (std::size_t n = 0; n < cells_.size(); ++n)
    sum += edges_.strength[n] * static_cast<float>(maps_[static_cast<std::size_t>(cells_[n])]);
  return sum * static_cast<float>(edges_.stride) / (255.0F * static_cast<float>(field_.length_px));
}

}  // namespace mapscore
