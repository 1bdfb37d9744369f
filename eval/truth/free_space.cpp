// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/free_space.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr double kFarthestFreeIndex = (1 << 20) - 16;
/// Far above rounding, far below a voxel: what is passed over must be out of view for certain.
constexpr double kSlack_m = 1e-6, kSlack_px = 1e-3;

/// Greatest value of a depth image by tiles of 16 x 16 pixels, to skip voxels that lie behind all
/// measured surfaces. Immutable.
class DepthBounds {
 public:
  explicit DepthBounds(const cv::Mat1w& depth)
      : tiles_(
            cv::Mat1w::zeros((depth.rows + kTile - 1) / kTile, (depth.cols + kTile - 1) / kTile)) {
    for (int v = 0; v < depth.rows; ++v) {
      const std::uint16_t* row = depth[v];
      std::uint16_t* tiles = tiles_[v / kTile];
      for (int u = 0; u < depth.cols; ++u) {
        tiles[u / kTile] = std::max(tiles[u / kTile], row[u]);
        most_ = std::max(most_, row[u]);
      }
    }
  }

  /// Of the whole image.
  [[nodiscard]] std::uint16_t most() const { return most_; }
  /// At least the greatest value in columns first_u to last_u and rows first_v to last_v, all
  /// within the image; 0 when there are none.
  [[nodiscard]] std::uint16_t most_in(int first_u, int last_u, int first_v, int last_v) const {
    std::uint16_t most = 0;
    if (first_u > last_u || first_v > last_v) return most;
    for (int v = first_v / kTile; v <= last_v / kTile; ++v) {
      const std::uint16_t* tiles = tiles_[v];
      for (int u = first_u / kTile; u <= last_u / kTile; ++u) most = std::max(most, tiles[u]);
    }
    return most;
  }

 private:
  static constexpr int kTile = 16;

  cv::Mat1w tiles_;
  std::uint16_t most_ = 0;
};

std::uint64_t bit_of(int j, int k) {
  return std::uint64_t{1} << (8 * j + k);
}

void check(const Frame& frame, const CameraModel& camera, const Pose& T_map_depth) {
  if (frame.depth.size() != cv::Size(camera.width_px, camera.height_px)) {
    throw Error(
        fmt::format("frame {}: depth must have the depth camera's size, {} x {}; check "
                    "recording.yaml and that the image was read",
                    frame.index, camera.width_px, camera.height_px));
  }
  if (!T_map_depth.matrix().allFinite()) {
    throw Error(fmt::format(
        "frame {}: its pose is not finite; mend groundtruth.txt or T_base_depth", frame.index));
  }
}

}  // namespace

/// What one frame sees, from the map.
class FreeSpace::View {
 public:
  View(const Frame& frame, const Calibration& calibration, const Pose& T_map_depth, double edge_m)
      : depth_(frame.depth),
        bounds_(frame.depth),
        camera_(calibration.depth),
        R_(T_map_depth.linear()),
        t_(T_map_depth.translation()),
        edge_m_(edge_m),
        z_min_(calibration.range_min_m),
        z_max_(std::min(calibration.range_max_m, bounds_.most() / kDepthUnitsPerMetre)) {}

  /// Lowest and highest of the blocks around all that the frame can see through; nothing when it
  /// sees nothing.
  [[nodiscard]] std::optional<std::pair<VoxelKey, VoxelKey>> blocks(int frame_index) const {
    if (!(z_min_ <= z_max_) || !(z_max_ > 0.0)) return std::nullopt;
    Eigen::AlignedBox3d box;
    for (const double u : {-0.5, camera_.width_px - 0.5}) {
      for (const double v : {-0.5, camera_.height_px - 0.5}) {
        for (const double z : {z_min_, z_max_}) {
          box.extend(R_ * camera_.back_project(u, v, z) + t_);
        }
      }
    }
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kSlack_m);
    const Eigen::Vector3d low = (box.min() - margin) / edge_m_,
                          high = (box.max() + margin) / edge_m_;
    if (!(low.minCoeff() > -kFarthestFreeIndex && high.maxCoeff() < kFarthestFreeIndex)) {
      throw Error(
          fmt::format("frame {}: its view reaches beyond 2^20 voxels of {} m; choose larger voxels",
                      frame_index, edge_m_));
    }
    const double block_m = edge_m_ * kBlockEdge;
    return std::pair{voxel_of(low * edge_m_, block_m), voxel_of(high * edge_m_, block_m)};
  }

  /// False only when the frame sees through no voxel's centre in the block.
  [[nodiscard]] bool may_see(const VoxelKey& block) const {
    const double radius =
        0.5 * (kBlockEdge - 1) * edge_m_ * std::numbers::sqrt3 + kSlack_m;  // around all centres
    const Eigen::Vector3d p = R_.transpose() * (centre_of(block, edge_m_ * kBlockEdge) - t_);
    const double near = p.z() - radius, far = p.z() + radius;
    if (far < z_min_ || near > z_max_) return false;
    if (near < radius) return true;  // the view around the camera is too wide to be bounded
    // First and last pixel that the ball around the block covers along an axis of the image.
    const auto covered = [=](double x, double focal, double centre, int size) {
      const double low = x - radius, high = x + radius;
      const double first = focal * (low / (low < 0.0 ? near : far)) + centre + 0.5 - kSlack_px;
      const double last = focal * (high / (high > 0.0 ? near : far)) + centre + 0.5 + kSlack_px;
      return std::pair{static_cast<int>(std::clamp(std::floor(first), -1.0, 1.0 * size)),
                       static_cast<int>(std::clamp(std::floor(last), -1.0, 1.0 * size))};
    };
    const auto [first_u, last_u] = covered(p.x(), camera_.fx_px, camera_.cx_px, camera_.width_px);
    const auto [first_v, last_v] = covered(p.y(), camera_.fy_px, camera_.cy_px, camera_.height_px);
    const std::uint16_t most =
        bounds_.most_in(std::max(first_u, 0), std::min(last_u, camera_.width_px - 1),
                        std::max(first_v, 0), std::min(last_v, camera_.height_px - 1));
    return most > 0 && near <= most / kDepthUnitsPerMetre;
  }

  /// Bits of the row of voxels (i, j, k) .. (i, j, k + 7) that are not in `settled` and whose
  /// centres are seen through.
  [[nodiscard]] unsigned row(const VoxelKey& first, unsigned settled) const {
    const Eigen::Vector3d c = centre_of(first, edge_m_);
    const double qx = c.x() - t_.x(), qy = c.y() - t_.y();
    const Eigen::Vector3d base(R_(0, 0) * qx + R_(1, 0) * qy, R_(0, 1) * qx + R_(1, 1) * qy,
                               R_(0, 2) * qx + R_(1, 2) * qy);
    unsigned seen = 0;
    for (int n = 0; n < kBlockEdge; ++n) {
      if (settled >> n & 1u) continue;
      const double qz = (first.k + n + 0.5) * edge_m_ - t_.z();
      const bool through = sees_through(base.x() + R_(2, 0) * qz, base.y() + R_(2, 1) * qz,
                                        base.z() + R_(2, 2) * qz);
      seen |= static_cast<unsigned>(through) << n;
    }
    return seen;
  }

 private:
  [[nodiscard]] bool sees_through(double x, double y, double z) const {
    if (!(z >= z_min_ && z <= z_max_)) return false;
    const double u = camera_.fx_px * x / z + camera_.cx_px + 0.5;
    const double v = camera_.fy_px * y / z + camera_.cy_px + 0.5;
    if (!(u >= 0.0 && u < camera_.width_px && v >= 0.0 && v < camera_.height_px)) return false;
    const std::uint16_t value = depth_(static_cast<int>(v), static_cast<int>(u));
    return value != 0 && z <= value / kDepthUnitsPerMetre;
  }

  const cv::Mat1w& depth_;
  const DepthBounds bounds_;
  const CameraModel& camera_;
  const Eigen::Matrix3d R_;
  const Eigen::Vector3d t_;
  const double edge_m_;
  const double z_min_, z_max_;
};

FreeSpace::FreeSpace(const SurfaceTruth& surface) : edge_m_(surface.edge_m()) {
  for (const SurfaceVoxel& voxel : surface.voxels()) {
    const VoxelKey& key = voxel.key;
    Block& block = blocks_[{key.i >> 3, key.j >> 3, key.k >> 3}];
    block.settled[static_cast<std::size_t>(key.i & 7)] |= bit_of(key.j & 7, key.k & 7);
  }
}

void FreeSpace::add(const Frame& frame, const Calibration& true_calibration,
                    const Pose& T_map_base) {
  const Pose T_map_depth = T_map_base * true_calibration.T_base_depth;
  check(frame, true_calibration.depth, T_map_depth);
  const View view(frame, true_calibration, T_map_depth, edge_m_);
  const auto range = view.blocks(frame.index);
  if (!range) return;
  const auto& [low, high] = *range;
  for (int i = low.i; i <= high.i; ++i) {
    for (int j = low.j; j <= high.j; ++j) {
      for (int k = low.k; k <= high.k; ++k) {
        if (view.may_see({i, j, k})) look(view, {i, j, k});
      }
    }
  }
}

void FreeSpace::look(const View& view, const VoxelKey& block) {
  const auto known = blocks_.find(block);
  Block settled = known == blocks_.end() ? Block{} : known->second;
  bool any = false;
  for (int i = 0; i < kBlockEdge; ++i) {
    const auto word = static_cast<std::size_t>(i);
    for (int j = 0; j < kBlockEdge; ++j) {
      const auto before = static_cast<unsigned>(settled.settled[word] >> (8 * j) & 0xffu);
      if (before == 0xffu) continue;
      const VoxelKey first{8 * block.i + i, 8 * block.j + j, 8 * block.k};
      const std::uint64_t seen = std::uint64_t{view.row(first, before)} << (8 * j);
      settled.settled[word] |= seen;
      settled.free[word] |= seen;
      any |= seen != 0;
    }
  }
  if (any) blocks_[block] = settled;
}

void FreeSpace::merge(const FreeSpace& other) {
  if (other.edge_m_ != edge_m_) {
    throw Error(fmt::format("voxel_m: free space of {} and {} m do not add; make both at one size",
                            edge_m_, other.edge_m_));
  }
  for (const auto& [key, block] : other.blocks_) {
    Block& own = blocks_[key];
    for (std::size_t i = 0; i < kBlockEdge; ++i) {
      own.settled[i] |= block.settled[i];
      own.free[i] |= block.free[i];
    }
  }
}

std::vector<VoxelKey> FreeSpace::voxels() const {
  // Rows along k are short and whole, so only they are sorted.
  // By the packed key of the voxel at the block's low k, with a bit for each that is free.
  std::vector<std::pair<std::uint64_t, unsigned>> rows;
  std::size_t count = 0;
  for (const auto& [low, block] : blocks_) {
    for (int i = 0; i < kBlockEdge; ++i) {
      const std::uint64_t word = block.free[static_cast<std::size_t>(i)];
      count += static_cast<std::size_t>(std::popcount(word));
      for (int j = 0; j < kBlockEdge; ++j) {
        const auto free = static_cast<unsigned>(word >> (8 * j) & 0xffu);
        if (free == 0) continue;
        rows.emplace_back(pack({8 * low.i + i, 8 * low.j + j, 8 * low.k}), free);
      }
    }
  }
  std::ranges::sort(rows);
  std::vector<VoxelKey> voxels;
  voxels.reserve(count);
  for (const auto& [first, row] : rows) {
    VoxelKey key = unpack(first);
    for (unsigned free = row; free != 0; free >>= 1, ++key.k) {
      if (free & 1u) voxels.push_back(key);
    }
  }
  return voxels;
}

}  // namespace mapscore::eval
