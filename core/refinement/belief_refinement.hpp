// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/class_beliefs.hpp"
#include "core/refinement/dense_crf.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// The beliefs of a map's voxels after the dense CRF (docs/refinement.md), in the same order.
/// Labels are the classes that some voxel names, background among them where it is named. Under
/// `apart` voxels that name no class say nothing and stay as they are; under `label` they are
/// wholly unknown. Counts become probabilities; classes below 1e-6 are forgotten. `colours` may be
/// empty where the appearance kernel is off. Throws Error as refine() does.
[[nodiscard]] std::vector<ClassBeliefs> refine_beliefs(std::span<const Eigen::Vector3d> centres_m,
                                                       std::span<const Colour> colours,
                                                       std::span<const ClassBeliefs> beliefs,
                                                       const Crf& crf, int jobs = 1);

}  // namespace mapscore
