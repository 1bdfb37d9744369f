// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/trial_refinement.hpp"

#include <algorithm>
#include <variant>

namespace mapscore::eval {

std::optional<TrialRefinement> trial_refinement(const RefinementSettings& settings) {
  const auto* crf = std::get_if<CrfSettings>(&settings);
  if (crf == nullptr) return std::nullopt;
  TrialRefinement refinement;
  refinement.rest = crf->rest;
  CrfParams& params = refinement.params;
  params.smoothness_weight = crf->smoothness_weight;
  params.smoothness_sigma_m = crf->smoothness_sigma_m;
  params.appearance_weight = crf->appearance_weight;
  params.appearance_sigma_m = crf->appearance_sigma_m;
  params.appearance_sigma_colour = crf->appearance_sigma_colour;
  params.iterations = crf->iterations;
  params.filter = crf->filter;
  return refinement;
}

bool reads_colour(const Study& study) {
  return std::ranges::any_of(study.methods, [](const MethodSettings& method) {
    const auto refinement = trial_refinement(method.refinement);
    return refinement && refinement->reads_colour();
  });
}

}  // namespace mapscore::eval
