// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/semantic_map.hpp"
#include "core/random_stream.hpp"

#include <map>
#include <tuple>
#include <vector>

// Small carved maps that the tests of the octree share.

namespace mapscore::testing {

inline constexpr double kEdge = 0.1;
inline const BlendRule kBlend{};

inline std::vector<std::tuple<VoxelKey, ClassId, double, bool>> rows(
    const std::vector<MapVoxel>& voxels) {
  std::vector<std::tuple<VoxelKey, ClassId, double, bool>> rows;
  for (const MapVoxel& v : voxels)
    rows.emplace_back(v.key, v.best_class, v.probability, v.occupied);
  return rows;
}

/// One frame: a patch of a wall at x = 1.5 and a box of one class in front of it, seen from afar.
struct View {
  Eigen::Vector3d origin;
  std::vector<Eigen::Vector3d> points;
  std::vector<VoxelHit> hits;
  std::vector<ColouredPoint> colours;
};

inline View random_view(RandomStream& stream) {
  View view{{-1.55, 0.3 * stream.uniform(), 0.05}, {}, {}, {}};
  std::map<VoxelKey, ClassId> classes;
  for (int n = 0; n < 400; ++n) {
    Eigen::Vector3d p(1.5, 4 * stream.uniform() - 2, 3 * stream.uniform() - 1.5);
    if (n % 4 == 0) p = {0.45, 0.8 * stream.uniform() + 0.2, 0.8 * stream.uniform()};
    view.points.push_back(p);
    const auto shade = static_cast<std::uint8_t>(stream.uniform() * 255);
    view.colours.push_back({p, {shade, 10, static_cast<std::uint8_t>(255 - shade)}});
    if (n % 4 == 0 || n % 9 == 0) classes[voxel_of(p, kEdge)] = static_cast<ClassId>(1 + n % 3);
  }
  for (const auto& [key, id] : classes) view.hits.push_back({key, id, 1, 1.0});
  return view;
}

inline void add(const View& view, const FusionRule& rule, SemanticMap& map) {
  map.see(view.origin, view.points, view.hits);
  map.fuse(view.hits, 1, rule);
  map.add_colours(view.colours);
}

inline SemanticMap carved_map(int frames, const FusionRule& rule = kBlend, int seed = 1) {
  RandomStream stream(static_cast<std::uint64_t>(seed), "views");
  SemanticMap map(kEdge, {.carve = true});
  for (int n = 0; n < frames; ++n) add(random_view(stream), rule, map);
  return map;
}

}  // namespace mapscore::testing
