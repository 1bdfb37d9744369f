// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/sample_counter.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kFirstSlots = 1 << 12;
constexpr int kFarthestSampleIndex = (1 << 20) - 1;

/// floor(a) for |a| below 2^31; compiles to two instructions and vectorises, unlike std::floor on
/// processors without SSE 4.1.
std::int32_t floor_index(double a) {
  const auto truncated = static_cast<std::int32_t>(a);
  return truncated - (a < truncated);
}

/// In place of a packed key: no sample.
constexpr std::uint64_t kNoSample = ~std::uint64_t{0};

/// Smallest and largest raw depth value within the range.
struct RawRange {
  explicit RawRange(const Calibration& calibration) {
    const auto within = [&](int raw) {
      const double z = raw / kDepthUnitsPerMetre;
      return z >= calibration.range_min_m && z <= calibration.range_max_m;
    };
    while (low <= 65535 && !within(low)) ++low;
    while (high >= low && !within(high)) --high;
  }
  int low = 1, high = 65535;
};

// Compiled for several widths, of which the processor's is chosen when the program starts; no
// result depends on the width: there are neither sums over pixels nor fused products.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("default", "avx2", "avx512f")]]
#endif
void place_row(const std::uint16_t* depth, const DepthRays& rays, int v, const Pose& T_map_depth,
               double edge_m, const RawRange& range, std::uint64_t* keys) {
  const Eigen::Matrix3d R = T_map_depth.linear();
  const Eigen::Vector3d t = T_map_depth.translation();
  const int width = static_cast<int>(rays.x().size());
  const double* ray_x = rays.x().data();
  const double ray_y = rays.y()[v];
  const int low = range.low, high = range.high;
  for (int u = 0; u < width; ++u) {
    const double z = depth[u] / kDepthUnitsPerMetre;
    const double x = z * ray_x[u];
    const double y = z * ray_y;
    const std::uint64_t key =
        pack({floor_index((R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + t.x()) / edge_m),
              floor_index((R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + t.y()) / edge_m),
              floor_index((R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + t.z()) / edge_m)});
    keys[u] = depth[u] >= low && depth[u] <= high ? key : kNoSample;
  }
}

void check(const Frame& frame, const Calibration& calibration, const Pose& T_map_depth,
           double edge_m) {
  const std::string where = "frame " + std::to_string(frame.index) + ": ";
  const CameraModel& camera = calibration.depth;
  check_depth_images(frame, camera);
  if (!T_map_depth.matrix().allFinite()) {
    throw Error(where + "its pose is not finite; mend groundtruth.txt or T_base_depth");
  }
  const Eigen::Vector3d corner(
      std::max(camera.cx_px, camera.width_px - camera.cx_px) / camera.fx_px,
      std::max(camera.cy_px, camera.height_px - camera.cy_px) / camera.fy_px, 1);
  const double farthest_m =
      T_map_depth.translation().norm() + 65535 / kDepthUnitsPerMetre * corner.norm();
  if (!(farthest_m / edge_m < kFarthestSampleIndex)) {
    throw Error(where + "samples may lie beyond 2^20 voxels of " + std::to_string(edge_m) +
                " m from the map's origin; take larger voxels or check its pose");
  }
}

}  // namespace

void check_depth_images(const Frame& frame, const CameraModel& camera) {
  const cv::Size size(camera.width_px, camera.height_px);
  if (frame.depth.size() == size && frame.depth_label.size() == size) return;
  throw Error(
      fmt::format("frame {}: depth and depth_label must have the depth camera's size, {} x {}; "
                  "check recording.yaml and that both images were read",
                  frame.index, size.width, size.height));
}

SampleCounter::SampleCounter(double edge_m) : edge_m_(edge_m), slots_(kFirstSlots) {
  if (!(std::isfinite(edge_m) && edge_m > 0)) {
    throw Error("voxel_m: is " + std::to_string(edge_m) + "; give a positive edge in metres");
  }
}

void SampleCounter::add(const Frame& frame, const Calibration& true_calibration,
                        const ClassTable& table, const Pose& T_map_base) {
  const Pose T_map_depth = T_map_base * true_calibration.T_base_depth;
  check(frame, true_calibration, T_map_depth, edge_m_);
  const DepthRays rays(true_calibration.depth);
  const RawRange range(true_calibration);
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(frame.depth.cols));
  for (int v = 0; v < frame.depth.rows; ++v) {
    const std::uint16_t* label = frame.depth_label[v];
    place_row(frame.depth[v], rays, v, T_map_depth, edge_m_, range, keys.data());
    // Neighbours mostly share voxel and instance, so the table is asked once a run.
    for (std::size_t u = 0; u < keys.size();) {
      const std::size_t first = u++;
      while (u < keys.size() && keys[u] == keys[first] && label[u] == label[first]) ++u;
      if (keys[first] != kNoSample)
        count(keys[first], table.class_of(label[first]), static_cast<std::uint32_t>(u - first));
    }
  }
}

void SampleCounter::merge(const SampleCounter& other) {
  if (other.edge_m_ != edge_m_) {
    throw Error("voxel_m: counts of " + std::to_string(edge_m_) + " and " +
                std::to_string(other.edge_m_) + " m do not add; count both at one size");
  }
  // Room first: slots come in the order of their hashes, which would crowd one end of a small
  // table.
  while (2 * (used_ + other.used_) > slots_.size()) grow();
  for (const Slot& slot : other.slots_) {
    if (slot.samples > 0) count(slot.key, slot.class_id, slot.samples);
  }
}

std::vector<SampleCount> SampleCounter::counts() const {
  std::vector<SampleCount> counts;
  counts.reserve(used_);
  for (const Slot& slot : slots_) {
    if (slot.samples > 0) counts.push_back({unpack(slot.key), slot.class_id, slot.samples});
  }
  std::ranges::sort(counts, {}, [](const SampleCount& c) { return std::tie(c.key, c.class_id); });
  return counts;
}

void SampleCounter::count(std::uint64_t key, ClassId class_id, std::uint32_t samples) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  Slot& slot = slots_[position(key, class_id)];
  if (slot.samples == 0) {
    slot = {key, 0, class_id};
    ++used_;
  }
  slot.samples += samples;
}

std::size_t SampleCounter::position(std::uint64_t key, ClassId class_id) const {
  const std::size_t mask = slots_.size() - 1;
  // A packed key leaves no room for the class, so the hash takes it in by a product of its own.
  std::size_t at = mix_bits(key ^ (class_id * 0x9e3779b97f4a7c15ULL)) & mask;
  while (slots_[at].samples != 0 && (slots_[at].key != key || slots_[at].class_id != class_id)) {
    at = (at + 1) & mask;
  }
  return at;
}

void SampleCounter::grow() {
  const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  for (const Slot& slot : old) {
    if (slot.samples > 0) slots_[position(slot.key, slot.class_id)] = slot;
  }
}

}  // namespace mapscore::eval
