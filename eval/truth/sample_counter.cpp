// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/sample_counter.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"
#include "core/geometry/voxel_packer.hpp"
#include "core/wide_vectors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kFirstSlots = 1 << 12;
constexpr int kFarthestSampleIndex = (1 << 20) - 1;

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

/// Packed voxels of a row of the depth image, kNone where there is no sample.
MAPSCORE_WIDE_VECTORS
void pack_row(const std::uint16_t* depth, const double* ray_x, double ray_y, std::size_t width,
              const VoxelPacker& packer, const RawRange& range, std::uint64_t* packed) {
  const VoxelPacker pack = packer;
  const int low = range.low, high = range.high;
  for (std::size_t u = 0; u < width; ++u) {
    const std::int32_t raw = depth[u];
    const double z = raw / kDepthUnitsPerMetre;
    const std::uint64_t voxel = pack(z * ray_x[u], z * ray_y, z);
    const auto outside = static_cast<std::uint64_t>((raw < low) | (raw > high));
    packed[u] = voxel | (std::uint64_t{0} - outside);
  }
}

/// Where the runs of one voxel and one instance begin in a row, and after them its end. Without
/// branches, which would be guessed wrong at the end of each run. `starts` has room for one more
/// than the row.
std::span<const std::uint32_t> runs_of(std::span<const std::uint64_t> packed,
                                       const std::uint16_t* label,
                                       std::vector<std::uint32_t>& starts) {
  std::size_t runs = 0;
  starts[runs++] = 0;
  for (std::size_t u = 1; u < packed.size(); ++u) {
    starts[runs] = static_cast<std::uint32_t>(u);
    runs += (packed[u] != packed[u - 1]) | (label[u] != label[u - 1]);
  }
  starts[runs] = static_cast<std::uint32_t>(packed.size());
  return std::span(starts).first(runs + 1);
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
  const VoxelPacker packer(T_map_depth, edge_m_);
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(frame.depth.cols));
  std::vector<std::size_t> places(keys.size(), 0);
  std::vector<std::uint32_t> starts(keys.size() + 1);
  for (int v = 0; v < frame.depth.rows; ++v) {
    const std::uint16_t* label = frame.depth_label[v];
    pack_row(frame.depth[v], rays.x().data(), rays.y()[static_cast<std::size_t>(v)], keys.size(),
             packer, range, keys.data());
    // Neighbours mostly share voxel and instance: the table is asked once a run, and first at the
    // place that it gave for the pixel above.
    const std::span runs = runs_of(keys, label, starts);
    for (std::size_t n = 0; n + 1 < runs.size(); ++n) {
      const std::size_t first = runs[n];
      if (keys[first] == VoxelPacker::kNone) continue;
      const ClassId class_id = table.class_of(label[first]);
      const std::uint32_t samples = runs[n + 1] - runs[n];
      Slot& above = slots_[places[first]];
      if (above.samples > 0 && above.key == keys[first] && above.class_id == class_id)
        above.samples += samples;
      else
        std::fill_n(places.begin() + static_cast<std::ptrdiff_t>(first), samples,
                    count(keys[first], class_id, samples));
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
  std::ranges::sort(counts, {},
                    [](const SampleCount& c) { return std::pair(pack(c.key), c.class_id); });
  return counts;
}

std::size_t SampleCounter::count(std::uint64_t key, ClassId class_id, std::uint32_t samples) {
  if (2 * (used_ + 1) > slots_.size()) grow();
  const std::size_t place = position(key, class_id);
  Slot& slot = slots_[place];
  if (slot.samples == 0) {
    slot = {key, 0, class_id};
    ++used_;
  }
  slot.samples += samples;
  return place;
}

std::size_t SampleCounter::position(std::uint64_t key, ClassId class_id) const {
  const std::size_t mask = slots_.size() - 1;
  // A packed key leaves no room for the class, so the hash takes it in by a product of its own.
  // Four voxels above each other stand together: a camera sees them one after the other.
  const std::uint64_t column = mix_bits((key >> 2) ^ (class_id * 0x9e3779b97f4a7c15ULL));
  std::size_t at = (column << 2 | (key & 3)) & mask;
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
