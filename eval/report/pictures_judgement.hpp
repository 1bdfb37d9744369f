// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/score/prediction.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <array>
#include <cstdint>
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

/// How many voxels have a verdict.
[[nodiscard]] std::int64_t count(const std::vector<JudgedVoxel>& voxels, Verdict verdict);

}  // namespace mapscore::eval
