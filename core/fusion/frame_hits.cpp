// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/frame_hits.hpp"

#include "core/error.hpp"

#include <string>
#include <tuple>

namespace mapscore {
namespace {

/// Sums of scores of 1 or a little less are rounded up by no more.
constexpr double kRounding = 1e-9;

std::size_t classes_of(const FusionRule& rule, std::size_t class_count) {
  if (const auto* bayes = std::get_if<BayesRule>(&rule))
    return std::min(class_count, bayes->priors.size());
  if (const auto* top3 = std::get_if<Top3Rule>(&rule))
    return std::min(class_count, static_cast<std::size_t>(top3->classes));
  return class_count;
}

void check_hit(const VoxelHit& hit, std::size_t classes) {
  if (hit.class_id >= classes)
    throw Error("hits: class " + std::to_string(hit.class_id) + " is beyond the table of " +
                std::to_string(classes) + " classes; map with the table of the detections");
  if (hit.draws < 1) throw Error("hits: a class is listed that won no draw; leave it out");
  if (!(hit.score_sum >= 0.0 && hit.score_sum <= hit.draws * (1.0 + kRounding)))
    throw Error("hits: the scores of a class do not lie in (0, 1]; give detections such scores");
}

}  // namespace

void check_fusion(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
                  std::size_t class_count) {
  check(rule);
  if (draws < 1) throw Error("N: the number of draws must be at least 1");
  const std::size_t classes = classes_of(rule, class_count);
  int in_voxel = 0;
  for (std::size_t n = 0; n < hits.size(); ++n) {
    check_hit(hits[n], classes);
    const bool same = n > 0 && hits[n].key == hits[n - 1].key;
    in_voxel = (same ? in_voxel : 0) + hits[n].draws;
    if (in_voxel > draws)
      throw Error("N: a voxel was hit by more than N draws; give the N that it was placed with");
    if (n > 0 &&
        std::tie(hits[n - 1].key, hits[n - 1].class_id) >= std::tie(hits[n].key, hits[n].class_id))
      throw Error("hits: must ascend by voxel, then class; give them as placed");
  }
}

}  // namespace mapscore
