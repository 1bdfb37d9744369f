// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/map_refinement.hpp"

#include <cmath>
#include <utility>

namespace mapscore {
namespace {

/// Mean of the colours that are there; black without any.
Colour mean_colour(const std::vector<BelievedVoxel>& voxels) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const BelievedVoxel& voxel : voxels) {
    if (!voxel.colour) continue;
    sum += Eigen::Vector3d(voxel.colour->r, voxel.colour->g, voxel.colour->b);
    count += 1.0;
  }
  if (count == 0.0) return {0, 0, 0};
  const auto channel = [&](int n) {
    return static_cast<std::uint8_t>(std::lround(sum[n] / count));
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

void refine(SemanticMap& map, const Crf& crf, int jobs) {
  std::vector<BelievedVoxel> voxels = map.believed_voxels();
  const Colour elsewhere = mean_colour(voxels);
  std::vector<Eigen::Vector3d> centres_m;
  std::vector<Colour> colours;
  std::vector<ClassBeliefs> beliefs;
  for (BelievedVoxel& voxel : voxels) {
    centres_m.push_back(centre_of(voxel.key, map.edge_m()));
    colours.push_back(voxel.colour.value_or(elsewhere));
    beliefs.push_back(std::move(voxel.beliefs));
  }
  std::vector<ClassBeliefs> refined = refine_beliefs(centres_m, colours, beliefs, crf, jobs);
  for (std::size_t n = 0; n < voxels.size(); ++n)
    map.set_beliefs(voxels[n].key, std::move(refined[n]));
}

}  // namespace mapscore
