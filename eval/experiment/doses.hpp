// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/segmentation.hpp"
#include "eval/experiment/study.hpp"
#include "sim/faults/calibration_faults.hpp"
#include "sim/faults/pose_fault.hpp"

namespace mapscore::eval {

// From the settings of a study, in the units of its file, to the types of core and sim, in SI.

[[nodiscard]] sim::MisregistrationDose dose_of(const MisregistrationSettings& settings);
[[nodiscard]] sim::RigidDose dose_of(const MountSettings& settings);
[[nodiscard]] sim::PoseDose dose_of(const PoseNoiseSettings& settings);
/// Covariance that the mapper is told: reported_scale times the true one.
[[nodiscard]] Covariance6 reported_covariance(const PoseNoiseSettings& settings);
[[nodiscard]] SegmentationParams segmentation_params(const SegmentationSettings& settings);

}  // namespace mapscore::eval
