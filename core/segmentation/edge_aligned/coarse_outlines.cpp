// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/coarse_outlines.hpp"

#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace mapscore {
namespace {

constexpr int kBits = 8, kBest = 255;  // of how well an edge of one way fits a cell

}  // namespace

CoarseOutlines::CoarseOutlines(const EdgeColumns& edges, const OutlineField& field,
                               const Projection& project)
    : edges_(edges),
      field_(field),
      project_(project),
      cells_(field.coarse[0].total(), 0),
      bits_(edges.way.begin(), edges.way.end()),
      weights_(edges.x.size()) {
  for (int way = 0; way < 4; ++way) {
    const std::uint8_t* const map = field.coarse[static_cast<std::size_t>(way)][0];
    for (std::size_t n = 0; n < cells_.size(); ++n) cells_[n] |= map[n] << (kBits * way);
  }
  for (int& bits : bits_) bits *= kBits;
}

MAPSCORE_WIDE_VECTORS
void CoarseOutlines::weigh(const Eigen::Matrix3f& R, const Eigen::Vector3f& t) {
  const int count = static_cast<int>(edges_.x.size()), columns = field_.coarse[0].cols;
  const float *xs = edges_.x.data(), *ys = edges_.y.data(), *zs = edges_.z.data(),
              *strengths = edges_.strength.data();
  const int *const cells = cells_.data(), *const bits = bits_.data();
  float* const weights = weights_.data();
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
    const float nearness = 1.0F / Z;
    const float u = (fx * X * nearness + cx) * kCells, v = (fy * Y * nearness + cy) * kCells;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(std::min(std::max(0.0F, u), right - 1));
    const int row = static_cast<int>(std::min(std::max(0.0F, v), bottom - 1));
    const float counts = within ? strengths[n] : 0.0F;
    const int fit = (cells[row * columns + column] >> bits[n]) & kBest;
    weights[n] = counts * static_cast<float>(fit);
  }
}

float CoarseOutlines::score(const Eigen::Matrix3f& R, const Eigen::Vector3f& t) {
  weigh(R, t);
  std::array<float, EdgeColumns::kTogether> sums{};
  for (std::size_t first = 0; first < weights_.size(); first += sums.size())
    for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += weights_[first + lane];
  return std::accumulate(sums.begin(), sums.end(), 0.0F) * static_cast<float>(edges_.stride) /
         (kBest * static_cast<float>(field_.length_px));
}

}  // namespace mapscore
