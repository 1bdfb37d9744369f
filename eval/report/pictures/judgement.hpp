// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What a voxel of a map is, by the definitions that the score counts with.
enum class Verdict { right, near, leak, floating, missed };
inline constexpr std::array kVerdicts{Verdict::right, Verdict::near, Verdict::leak,
                                      Verdict::floating, Verdict::missed};

[[nodiscard]] const char* name_of(Verdict verdict);
[[nodiscard]] Colour colour_of(Verdict verdict);

struct JudgedVoxel {
  VoxelKey key;
  ClassId class_id = kBackground;  ///< predicted, or missed
  Verdict verdict = Verdict::right;
  bool covered = false;  ///< missed, but another class is predicted there and drawn in its place
};

/// Every predicted voxel, and every visible one that was missed, of the detected classes: as many
/// of each verdict as score_voxels counts. Ordered by verdict's kind (predicted first), then key.
[[nodiscard]] std::vector<JudgedVoxel> judge(const MapSnapshot& map, double threshold,
                                             const SurfaceTruth& surface,
                                             const VisibleTruth& visible, const ClassTable& table);

/// A visible voxel of a detected class, with the class that it belongs to.
struct TrueVoxel {
  VoxelKey key;
  ClassId class_id = kBackground;
};

/// A map with its verdicts, where it lies, and what could be seen of its scene.
struct JudgedMap {
  std::string name;   ///< in the names of files
  std::string title;  ///< above pictures; ASCII
  double edge_m = 0.05;
  Pose T_world_map = Pose::Identity();
  std::vector<JudgedVoxel> voxels;
  std::vector<TrueVoxel> truth;  ///< what the map should hold: everything visible and detected
  Eigen::AlignedBox3d seen_map;  ///< bounds of everything visible, frame map
};

/// Judges a map of the lattice that both truths lie on; `T_map_world` places it.
[[nodiscard]] JudgedMap judged_map(std::string name, std::string title, const MapSnapshot& map,
                                   double threshold, const SurfaceTruth& surface,
                                   const VisibleTruth& visible, const ClassTable& table,
                                   const Pose& T_map_world);

/// The judged voxels as points for CloudCompare and MeshLab: binary little-endian PLY, a vertex a
/// voxel in the order of `map.voxels`: float x y z (the centre, metres, frame map), uchar red green
/// blue (the verdict's colour), ushort class, uchar verdict (0 true, 1 near, 2 leak, 3 floating, 4
/// missed). A voxel that was missed under another class stands twice.
[[nodiscard]] std::string error_ply_bytes(const JudgedMap& map);

/// Writes them aside, then renames. Throws Error unless the file ends in .ply and can be written.
void write_error_ply(const std::filesystem::path& file, const JudgedMap& map);

}  // namespace mapscore::eval
