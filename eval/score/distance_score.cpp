// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distance_score.hpp"

#include "core/error.hpp"
#include "eval/score/nearest_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace mapscore::eval {

namespace {

DistanceTally accuracy_of(std::span<const VoxelKey> cubes, ClassId class_id,
                          const CubeDistance& distance_of, const ScoreOptions& options) {
  DistanceTally tally(options.distances_m);
  for (const VoxelKey& cube : cubes) tally.add(distance_of(cube, class_id));
  return tally;
}

/// `cubes` ordered by key. Samples in a predicted voxel have distance 0 and are counted without a
/// look.
DistanceTally completeness_of(std::span<const VoxelKey> cubes, ClassId class_id,
                              const SampleSet& samples, const ScoreOptions& options) {
  DistanceTally tally(options.distances_m);
  NearestCube nearest(cubes, samples.edge_m());
  for (const SampleSet::Group& group : samples.groups(class_id)) {
    if (std::binary_search(cubes.begin(), cubes.end(), group.key)) {
      tally.add(0.0, static_cast<std::int64_t>(group.count));
      continue;
    }
    nearest.enter(group.key);
    for (const Eigen::Vector3f& offset : samples.offsets(class_id, group)) {
      tally.add(nearest.distance_m(offset.cast<double>()));
    }
  }
  return tally;
}

}  // namespace

CubeDistance cube_distance(const std::vector<PreparedShape>& pieces, const ClassTable& table,
                           double edge_m) {
  std::vector<SurfaceDistance> surfaces;
  for (const SemanticClass& semantic : table.classes) {
    surfaces.emplace_back(pieces_of(pieces, table, semantic.id));
  }
  return [surfaces = std::move(surfaces), edge_m](const VoxelKey& key, ClassId class_id) {
    const VoxelKey next{key.i + 1, key.j + 1, key.k + 1};
    return surfaces.at(class_id)(Box(low_corner_of(key, edge_m), low_corner_of(next, edge_m)));
  };
}

void score_distances(const MapSnapshot& map, double threshold, const CubeDistance& distance_of,
                     const SampleSet& samples, const ScoreOptions& options, Counts& counts) {
  check(options);
  if (samples.class_count() != counts.size()) {
    throw Error(
        fmt::format("score: samples of {} classes and counts of {}; use one class table for both",
                    samples.class_count(), counts.size()));
  }
  const auto cubes = predicted_by_class(map, threshold, counts.size());
  for (std::size_t c = 1; c < counts.size(); ++c) {
    const auto class_id = static_cast<ClassId>(c);
    counts[c].accuracy = accuracy_of(cubes[c], class_id, distance_of, options);
    counts[c].completeness = completeness_of(cubes[c], class_id, samples, options);
  }
}

}  // namespace mapscore::eval
