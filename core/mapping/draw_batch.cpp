// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/draw_batch.hpp"

#include <algorithm>

namespace mapscore {
namespace {

/// In levels; far above the rounding of coordinates within a million voxels, far below what costs
/// time.
constexpr double kRounding = 5e-5;

}  // namespace

DrawBatch::DrawBatch(const PositionCells& cells, std::span<const Pose> T_map_sensor, double edge_m)
    : edge_m_(edge_m), size_(T_map_sensor.size()), padded_((size_ + 15) / 16 * 16) {
  for (std::size_t n = 0; n < padded_; ++n) {
    const Pose& pose = T_map_sensor[std::min(n, size_ - 1)];
    const Eigen::Matrix3d turn = pose.linear() * cells.R().transpose();
    const Eigen::Vector3d origin = pose.translation() / edge_m - turn * cells.offset();
    const Eigen::Matrix3d off = (turn - Eigen::Matrix3d::Identity()).cwiseAbs();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      for (int column = 0; column < 3; ++column)
        turn_[a][static_cast<std::size_t>(column)][n] = turn(axis, column);
      origin_[a][n] = origin[axis] - 0.5;
      margin_[a][n] = 0.5 * kCellLevels * off.row(axis).sum() + kRounding;
    }
    if (n >= size_) continue;
    all_ |= DrawSet::of(n);
    R_.emplace_back(pose.linear());
    t_.emplace_back(pose.translation());
  }
}

void DrawBatch::cut_axis(std::size_t axis, const Eigen::Vector3d& centre, AxisCut& cut,
                         Voxels& voxels) const {
  constexpr int kPositive = 1 << 21;  // truncates as floor does; what it rounds, the margin covers
  const auto& [x, y, z] = turn_[axis];
  const ByDraw &origin = origin_[axis], &margin = margin_[axis];
  const double c[3] = {centre.x(), centre.y(), centre.z()};
  alignas(16) std::array<std::int32_t, DrawSet::kMost> under, over;
  for (std::size_t n = 0; n < padded_; ++n) {
    const double low = x[n] * c[0] + y[n] * c[1] + z[n] * c[2] + origin[n];
    const int voxel = static_cast<int>(low + kPositive) - kPositive;
    const double boundary = kCellLevels * (voxel + 1.0 - low) + kLevelOffset;
    voxels[n] = voxel;
    under[n] = static_cast<int>(boundary - margin[n]);
    over[n] = static_cast<int>(boundary + margin[n]) + 1;
  }
  for (std::size_t n = 0; n < padded_; ++n) {
    cut.under.of[n] = static_cast<std::uint8_t>(under[n]);
    cut.over.of[n] = static_cast<std::uint8_t>(over[n]);
  }
}

void DrawBatch::cut(const PositionCell& cell, std::array<AxisCut, 3>& axes, CutBases& at) const {
  const Eigen::Vector3d centre = cell.low.array() + 0.5;
  std::array<Voxels, 3> voxels;
  for (std::size_t axis = 0; axis < 3; ++axis) cut_axis(axis, centre, axes[axis], voxels[axis]);
  constexpr std::uint8_t kNone = 255;
  std::array<std::uint8_t, 256> table;  // open addressing
  table.fill(kNone);
  at.bases.clear();
  for (std::size_t n = 0; n < size_; ++n) {
    const VoxelKey voxel{voxels[0][n], voxels[1][n], voxels[2][n]};
    unsigned place = static_cast<unsigned>(voxel.i + 8 * voxel.j + 64 * voxel.k) & 255;
    while (table[place] != kNone && at.bases[table[place]].voxel != voxel)
      place = (place + 1) & 255;
    if (table[place] == kNone) {
      table[place] = static_cast<std::uint8_t>(at.bases.size());
      at.bases.push_back({voxel, {}});
    }
    at.of[n] = table[place];
    at.bases[table[place]].draws.words[n / 64] |= std::uint64_t{1} << n % 64;
  }
}

}  // namespace mapscore
