// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/truth/free_space.hpp"
#include "eval/truth/sample_counter.hpp"
#include "eval/truth/surface_truth.hpp"

#include <span>
#include <vector>

namespace mapscore::eval {

/// What is known to be occupied and to be free; everything else is unknown. Both ascending, no
/// voxel in both.
struct OccupancyTruth {
  std::vector<VoxelKey> occupied;
  std::vector<VoxelKey> free;
};

/// Occupied: at least `min_samples` samples of any class in the voxel, background included; free:
/// in `free` and not occupied. Throws Error when the edges differ or min_samples is below 1.
[[nodiscard]] OccupancyTruth occupancy_truth(const SampleCounter& samples, int min_samples,
                                             const FreeSpace& free);

/// Of the frames `selected` of a recording, on the lattice of `surface`; `frames` must decode depth
/// and depth_label. Works on `jobs` threads, on which the result does not depend. Throws Error when
/// a frame cannot be read or used, or min_samples is below 1.
[[nodiscard]] OccupancyTruth make_occupancy_truth(FrameCache& frames, std::span<const int> selected,
                                                  const Calibration& true_calibration,
                                                  const Pose& T_map_world,
                                                  const SurfaceTruth& surface, int min_samples,
                                                  int jobs);

}  // namespace mapscore::eval
