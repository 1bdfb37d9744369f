// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/occupancy_truth.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

std::vector<VoxelKey> occupied_voxels(const SampleCounter& samples, int min_samples) {
  std::vector<VoxelKey> occupied;
  const std::vector<SampleCount> counts = samples.counts();  // by key, then class
  for (auto first = counts.begin(); first != counts.end();) {
    std::uint64_t in_voxel = 0;
    const VoxelKey key = first->key;
    for (; first != counts.end() && first->key == key; ++first) in_voxel += first->samples;
    if (in_voxel >= static_cast<std::uint64_t>(min_samples)) occupied.push_back(key);
  }
  return occupied;
}

}  // namespace

OccupancyTruth occupancy_truth(const SampleCounter& samples, int min_samples,
                               const FreeSpace& free) {
  if (min_samples < 1) {
    throw Error(fmt::format("min_samples: is {}; give at least 1", min_samples));
  }
  if (samples.edge_m() != free.edge_m()) {
    throw Error(
        fmt::format("voxel_m: samples of {} m and free space of {} m do not match; make "
                    "both at one size",
                    samples.edge_m(), free.edge_m()));
  }
  OccupancyTruth truth;
  truth.occupied = occupied_voxels(samples, min_samples);
  const std::vector<VoxelKey> seen = free.voxels();
  std::set_difference(seen.begin(), seen.end(), truth.occupied.begin(), truth.occupied.end(),
                      std::back_inserter(truth.free));
  return truth;
}

OccupancyTruth make_occupancy_truth(FrameCache& frames, std::span<const int> selected,
                                    const Calibration& true_calibration, const Pose& T_map_world,
                                    const SurfaceTruth& surface, int min_samples, int jobs) {
  struct Share {
    SampleCounter samples;
    FreeSpace free;
  };
  const ClassTable one_class;  // a sample counts whatever it is of
  std::optional<Share> all;
  std::mutex merging;
  Runs places(selected.size(), 1);
  run_jobs(jobs, [&](int) {
    Share share{SampleCounter(surface.edge_m()), FreeSpace(surface)};
    for (Runs::Run place; places.next(place);) {
      const auto frame = frames.get(selected[place.first]);
      const Pose T_map_base = T_map_world * frame->T_world_base;
      share.samples.add(*frame, true_calibration, one_class, T_map_base);
      share.free.add(*frame, true_calibration, T_map_base);
    }
    const std::scoped_lock lock(merging);
    if (!all) {
      all = std::move(share);
    } else {
      all->samples.merge(share.samples);
      all->free.merge(share.free);
    }
  });
  return occupancy_truth(all->samples, min_samples, all->free);
}

}  // namespace mapscore::eval
