// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/belief_refinement.hpp"
#include "eval/experiment/study.hpp"

#include <optional>

namespace mapscore::eval {

/// What happens to a trial's map before it is scored.
struct TrialRefinement {
  CrfRest rest = CrfRest::apart;
  CrfParams params;

  [[nodiscard]] bool reads_colour() const { return params.appearance_weight > 0.0; }
};

/// A method's refinement; none where the map is scored as it was fused.
[[nodiscard]] std::optional<TrialRefinement> trial_refinement(const RefinementSettings& settings);

/// Whether some method of a study reads colour images.
[[nodiscard]] bool reads_colour(const Study& study);

}  // namespace mapscore::eval
