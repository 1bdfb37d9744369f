// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/refinement/belief_refinement.hpp"

#include <string_view>
#include <variant>

namespace mapscore::eval {

// What a study does to a finished map; see study.hpp.

struct NoRefinementSettings {
  static constexpr std::string_view kKind = "none";
  static constexpr std::string_view kMeaning = "the map as it was fused";
  bool operator==(const NoRefinementSettings&) const = default;
};

/// Parameters of mapscore::CrfParams.
struct CrfSettings {
  static constexpr std::string_view kKind = "crf";
  static constexpr std::string_view kMeaning =
      "a fully connected conditional random field over the map's voxels (docs/refinement.md)";
  double smoothness_weight = 3, smoothness_sigma_m = 0.06;
  double appearance_weight = 3, appearance_sigma_m = 0.12, appearance_sigma_colour = 20;
  int iterations = 10;
  CrfRest rest = CrfRest::apart;
  CrfFilter filter = CrfFilter::neighbours;
  bool operator==(const CrfSettings&) const = default;
};

/// What happens to the finished map before it is scored.
using RefinementSettings = std::variant<NoRefinementSettings, CrfSettings>;

}  // namespace mapscore::eval
