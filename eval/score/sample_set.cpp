// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/sample_set.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::eval {

SampleSet::SampleSet(std::span<const std::vector<Eigen::Vector3d>> points_by_class, double edge_m)
    : edge_m_(edge_m) {
  for (const std::vector<Eigen::Vector3d>& points : points_by_class) {
    classes_.push_back(grouped(points, edge_m));
  }
}

SampleSet::ClassSamples SampleSet::grouped(std::span<const Eigen::Vector3d> points, double edge_m) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    order[p] = {pack(voxel_of(points[p], edge_m)), static_cast<std::uint32_t>(p)};
  }
  std::sort(order.begin(), order.end());
  ClassSamples samples;
  samples.offsets.reserve(points.size());
  for (const auto& [packed, p] : order) {
    const VoxelKey key = unpack(packed);
    if (samples.groups.empty() || samples.groups.back().key != key) {
      samples.groups.push_back({key, samples.offsets.size(), 0});
    }
    ++samples.groups.back().count;
    samples.offsets.push_back((points[p] - centre_of(key, edge_m)).cast<float>());
  }
  return samples;
}

}  // namespace mapscore::eval
