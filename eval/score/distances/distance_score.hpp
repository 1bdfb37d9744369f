// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/counts.hpp"
#include "eval/score/distances/sample_set.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/distance.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace mapscore::eval {

/// Euclidean distance in metres from the closed cube of a voxel to the exact boundary of the geoms
/// of a class, parts inside other solids included; kUnreached when the class has none.
using CubeDistance = std::function<double(const VoxelKey&, ClassId)>;

/// Exact surfaces by class id; copies share them.
using ClassDistances = std::vector<std::shared_ptr<const SurfaceDistance>>;

/// `pieces`: drawn surfaces in the map frame, background included.
[[nodiscard]] ClassDistances class_distances(const std::vector<PreparedShape>& pieces,
                                             const ClassTable& table);

/// The distance to these; may be called from several threads. Each is measured once: the function
/// and its copies keep 40 bytes for every voxel and class that was asked for.
[[nodiscard]] CubeDistance cube_distance(ClassDistances surfaces, double edge_m);

/// The distance to exact surfaces. `pieces`: drawn surfaces in the map frame, background included;
/// `edge_m`: edge of the lattice. The function may be called from several threads.
[[nodiscard]] CubeDistance cube_distance(const std::vector<PreparedShape>& pieces,
                                         const ClassTable& table, double edge_m);

/// Fills `accuracy` and `completeness` of every class of `counts` (made by score_voxels with the
/// same map, threshold and options): the distance from every predicted cube to the class's exact
/// surface, and from every noise-free sample of the class to the nearest predicted cube. Exact for
/// every voxel and sample; the time goes into samples outside predicted voxels. Throws Error when
/// the options are not usable or the class tables differ in size. Works on `jobs` threads, which
/// call `distance_of` at the same time; the counts do not depend on how many.
void score_distances(const MapSnapshot& map, double threshold, const CubeDistance& distance_of,
                     const SampleSet& samples, const ScoreOptions& options, Counts& counts,
                     int jobs = 1);

}  // namespace mapscore::eval
