// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Throws Error naming the frame when `depth` or `depth_label` has another size than the camera.
void check_depth_images(const Frame& frame, const CameraModel& camera);

/// How many depth samples of one class lie in one voxel.
struct SampleCount {
  VoxelKey key;
  ClassId class_id = kBackground;
  std::uint32_t samples = 0;
  bool operator==(const SampleCount&) const = default;
};

/// Counts the noise-free depth samples of frames by voxel and class. One sample is one pixel (u, v)
/// of the depth image, at its centre, with a value that is not 0 and range_min <= z <= range_max:
///
///   z = value / 5000.0,  p_depth = (z * ((u - cx) / fx), z * ((v - cy) / fy), z),
///   p_map = R p_depth + t  with  (R, t) = T_map_base * T_base_depth  and each row of R p_depth
///   summed from left to right, without fused multiply-add;  voxel = floor(p_map / edge),
///
/// all in doubles. Its class is table.class_of(depth_label). The counts do not depend on the order
/// of frames or merges. Not thread-safe: one per thread, merged at the end.
class SampleCounter {
 public:
  /// Throws Error when the edge is not positive.
  explicit SampleCounter(double edge_m);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  /// Adds the samples of one frame; reads `depth` and `depth_label`. Throws Error naming the frame
  /// when an image has another size than the camera, the pose is not finite, or the voxels do not
  /// fit.
  void add(const Frame& frame, const Calibration& true_calibration, const ClassTable& table,
           const Pose& T_map_base);
  /// Adds the counts of another counter of the same edge; throws Error otherwise.
  void merge(const SampleCounter& other);

  /// All counts, sorted by key, then class.
  [[nodiscard]] std::vector<SampleCount> counts() const;

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t samples = 0;  ///< 0: free
    ClassId class_id = 0;
  };

  /// Returns the place of the slot.
  std::size_t count(std::uint64_t key, ClassId class_id, std::uint32_t samples);
  [[nodiscard]] std::size_t position(std::uint64_t key, ClassId class_id) const;
  void grow();

  double edge_m_;
  std::vector<Slot> slots_;  ///< open addressing, linear probing, at most half full
  std::size_t used_ = 0;
};

}  // namespace mapscore::eval
