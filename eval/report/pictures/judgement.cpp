// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/pictures/judgement.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/report/colours.hpp"
#include "eval/score/voxel_window.hpp"
#include "files/point_ply.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace mapscore::eval {
namespace {

struct Look {
  const char* name;
  Colour colour;
};
/// Of each verdict.
constexpr std::array<Look, kVerdicts.size()> kLooks{{{"true", kTrueColour},
                                                     {"near", kNearColour},
                                                     {"leak", kLeakColour},
                                                     {"floating", kFloatingColour},
                                                     {"missed", kMissedColour}}};

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
  return kLooks.at(static_cast<std::size_t>(verdict)).name;
}

Colour colour_of(Verdict verdict) {
  return kLooks.at(static_cast<std::size_t>(verdict)).colour;
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

std::string error_ply_bytes(const JudgedMap& map) {
  std::string legend = "verdict";
  for (const Verdict verdict : kVerdicts)
    legend += fmt::format(" {} {}", static_cast<int>(verdict), name_of(verdict));
  PointPly ply(map.voxels.size(),
               {"uchar red", "uchar green", "uchar blue", "ushort class", "uchar verdict"}, legend);
  for (const JudgedVoxel& voxel : map.voxels) {
    const Colour colour = colour_of(voxel.verdict);
    ply.add(centre_of(voxel.key, map.edge_m), colour.r, colour.g, colour.b, voxel.class_id,
            static_cast<std::uint8_t>(voxel.verdict));
  }
  return ply.bytes();
}

void write_error_ply(const std::filesystem::path& file, const JudgedMap& map) {
  if (file.extension() != ".ply")
    throw Error(file.string() + ": errors are written as .ply; give the file this ending");
  write_whole_file(file, error_ply_bytes(map));
}

}  // namespace mapscore::eval
