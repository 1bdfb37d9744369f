// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/mapping/fusion_rule.hpp"
#include "core/mapping/pose_belief.hpp"
#include "eval/experiment/fusion_settings.hpp"

namespace mapscore::eval {

/// How the observations of a trial are drawn and fused.
struct TrialFusion {
  FusionRule rule;
  int N = 1;
  NoiseAt noise_at = NoiseAt::base;
  CovarianceUse covariance = CovarianceUse::diagonal;
};

/// A study's fusion for the classes of `table`, whose `detect` is the study's. Throws Error naming
/// the key when the priors do not fit the table.
[[nodiscard]] TrialFusion trial_fusion(const FusionSettings& settings, const ClassTable& table);

/// A method's own fusion, or the study's.
[[nodiscard]] FusionSettings fusion_of(const FusionSettings& of_study,
                                       const MethodFusionSettings& of_method);

/// Half of what a first full hit gives: the threshold that `auto` means.
[[nodiscard]] double default_threshold(const FusionRule& rule);

}  // namespace mapscore::eval
