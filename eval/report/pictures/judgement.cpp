// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/judgement.hpp"

#include "eval/report/colours.hpp"
#include "eval/score/voxel_window.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::eval {
namespace {

Verdict verdict_of(const PredictedVoxel& voxel, const SurfaceTruth& surface) {
  const auto in_surface = [&](const VoxelKey& key) {
    return surface.contains(key, voxel.class_id);
  };
  if (in_surface(voxel.key)) return Verdict::right;
  if (any_in_shell(voxel.key, 1, in_surface)) return Verdict::near;
  return surface.touches_any(voxel.key) ? Verdict::leak : Verdict::floating;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "true";
    case Verdict::near:
      return "near";
    case Verdict::leak:
      return "leak";
    case Verdict::floating:
      return "floating";
    case Verdict::missed:
      return "missed";
  }
  return "?";
}

Colour colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return kTrueColour;
    case Verdict::near:
      return kNearColour;
    case Verdict::leak:
      return kLeakColour;
    case Verdict::floating:
      return kFloatingColour;
    case Verdict::missed:
      return kMissedColour;
  }
  return {};
}

std::vector<JudgedVoxel> judge(const MapSnapshot& map, double threshold,
                               const SurfaceTruth& surface, const VisibleTruth& visible,
                               const ClassTable& table) {
  std::vector<JudgedVoxel> judged;
  for (const PredictedVoxel& voxel : prediction_of(map, threshold))
    if (table.detected(voxel.class_id))
      judged.push_back({voxel.key, voxel.class_id, verdict_of(voxel, surface), false});
  for (const VisibleVoxel& truth : visible.voxels()) {
    if (!table.detected(truth.owner)) continue;
    const MapVoxel* voxel = map.find(truth.key);
    const bool labelled = voxel && predicted(*voxel, threshold);
    if (labelled && voxel->best_class == truth.owner) continue;
    judged.push_back({truth.key, truth.owner, Verdict::missed, labelled});
  }
  return judged;
}

JudgedMap judged_map(std::string name, std::string title, const MapSnapshot& map, double threshold,
                     const SurfaceTruth& surface, const VisibleTruth& visible,
                     const ClassTable& table, const Pose& T_map_world) {
  JudgedMap judged{
      std::move(name), std::move(title), surface.edge_m(), T_map_world.inverse(), {}, {}, {}};
  judged.voxels = judge(map, threshold, surface, visible, table);
  for (const VisibleVoxel& voxel : visible.voxels()) {
    judged.seen_map.extend(centre_of(voxel.key, judged.edge_m));
    if (table.detected(voxel.owner)) judged.truth.push_back({voxel.key, voxel.owner});
  }
  return judged;
}

std::int64_t count(const std::vector<JudgedVoxel>& voxels, Verdict verdict) {
  return std::count_if(voxels.begin(), voxels.end(),
                       [&](const JudgedVoxel& voxel) { return voxel.verdict == verdict; });
}

}  // namespace mapscore::eval
