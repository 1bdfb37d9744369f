// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/distance_score.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/score/distances/nearest_cube.hpp"
#include "eval/score/voxel_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mapscore::eval {

namespace {

/// Items that a job takes at once: enough to be worth it, few enough to share evenly.
constexpr std::size_t kRunItems = 4096;

/// Distances that were asked for before: maps of one lattice mostly have the same voxels. Safe to
/// use from several threads.
class KnownDistances {
 public:
  double get(const VoxelKey& key, const auto& measure) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = known_.find(key); found != known_.end()) return found->second;
    }
    const double distance = measure();
    const std::scoped_lock lock(mutex_);
    return known_.emplace(key, distance).first->second;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<VoxelKey, double> known_;
};

/// Tally of `count` items, counted run by run on `jobs` threads. `make_counter()` gives each job
/// its own counter, called as counter(item, tally) with items in ascending order. Tallies are
/// integers: any order gives the same.
template <class MakeCounter>
DistanceTally tally_of(std::size_t count, const ScoreOptions& options, int jobs,
                       const MakeCounter& make_counter) {
  const int used = static_cast<int>(
      std::clamp<std::size_t>((count + kRunItems - 1) / kRunItems, 1, std::max(jobs, 1)));
  DistanceTally total(options.distances_m);
  std::mutex pooling;
  Runs runs(count, kRunItems);
  run_jobs(used, [&](int) {
    auto counter = make_counter();
    DistanceTally tally(options.distances_m);
    for (Runs::Run run; runs.next(run);) {
      for (std::size_t item = run.first; item < run.last; ++item) counter(item, tally);
    }
    const std::scoped_lock lock(pooling);
    total += tally;
  });
  return total;
}

DistanceTally accuracy_of(std::span<const VoxelKey> cubes, ClassId class_id,
                          const CubeDistance& distance_of, const ScoreOptions& options, int jobs) {
  return tally_of(cubes.size(), options, jobs, [&] {
    return [&](std::size_t cube, DistanceTally& tally) {
      tally.add(distance_of(cubes[cube], class_id));
    };
  });
}

/// `cubes` ordered by key. Samples in a predicted voxel have distance 0 and are counted without a
/// look.
DistanceTally completeness_of(std::span<const VoxelKey> cubes, ClassId class_id,
                              const SampleSet& samples, const ScoreOptions& options, int jobs) {
  const auto groups = samples.groups(class_id);
  const NearestCube prepared(cubes, samples.edge_m());
  return tally_of(groups.size(), options, jobs, [&] {
    return [&, nearest = prepared, predicted_rows = VoxelWindow<VoxelKey>(cubes, 0)](
               std::size_t item, DistanceTally& tally) mutable {
      const SampleSet::Group& group = groups[item];
      if (!predicted_rows.at(group.key).empty()) {
        tally.add(0.0, static_cast<std::int64_t>(group.count));
        return;
      }
      nearest.enter(group.key);
      for (const Eigen::Vector3f& offset : samples.offsets(class_id, group)) {
        tally.add(nearest.distance_m(offset.cast<double>()));
      }
    };
  });
}

}  // namespace

ClassDistances class_distances(const std::vector<PreparedShape>& pieces, const ClassTable& table) {
  ClassDistances surfaces;
  for (const SemanticClass& semantic : table.classes)
    surfaces.push_back(
        std::make_shared<const SurfaceDistance>(pieces_of(pieces, table, semantic.id)));
  return surfaces;
}

CubeDistance cube_distance(ClassDistances surfaces, double edge_m) {
  auto known = std::make_shared<std::vector<KnownDistances>>(surfaces.size());
  return [surfaces = std::move(surfaces), known, edge_m](const VoxelKey& key, ClassId class_id) {
    return known->at(class_id).get(key, [&] {
      const VoxelKey next{key.i + 1, key.j + 1, key.k + 1};
      return (*surfaces[class_id])(Box(low_corner_of(key, edge_m), low_corner_of(next, edge_m)));
    });
  };
}

CubeDistance cube_distance(const std::vector<PreparedShape>& pieces, const ClassTable& table,
                           double edge_m) {
  return cube_distance(class_distances(pieces, table), edge_m);
}

void score_distances(const MapSnapshot& map, double threshold, const CubeDistance& distance_of,
                     const SampleSet& samples, const ScoreOptions& options, Counts& counts,
                     int jobs) {
  check(options);
  if (samples.class_count() != counts.size()) {
    throw Error(
        fmt::format("score: samples of {} classes and counts of {}; use one class table for both",
                    samples.class_count(), counts.size()));
  }
  const auto cubes = predicted_by_class(map, threshold, counts.size());
  for (std::size_t c = 1; c < counts.size(); ++c) {
    const auto class_id = static_cast<ClassId>(c);
    counts[c].accuracy = accuracy_of(cubes[c], class_id, distance_of, options, jobs);
    counts[c].completeness = completeness_of(cubes[c], class_id, samples, options, jobs);
  }
}

}  // namespace mapscore::eval
