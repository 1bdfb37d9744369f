// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/fusion_rule.hpp"
#include "core/mapping/mapper.hpp"
#include "core/parameters.hpp"
#include "core/refinement/dense_crf.hpp"
#include "core/segmentation/segmentation.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mapscore::eval {

struct StudyFusion {
  static constexpr std::string_view kKind = "study";
  static constexpr std::string_view kMeaning = "as the study's `fusion`";

  static void fields(auto&, auto&&) {}
  bool operator==(const StudyFusion&) const = default;
};
/// Fusion of one method: the study's, or its own.
using MethodFusion = DrawnOf<FusionRule>::With<StudyFusion>;

struct NoRefinement {
  static constexpr std::string_view kKind = "none";
  static constexpr std::string_view kMeaning = "the map as it was fused";

  static void fields(auto&, auto&&) {}
  bool operator==(const NoRefinement&) const = default;
};
/// What happens to the finished map before it is scored.
using Refinement = std::variant<NoRefinement, Crf>;

struct MethodSettings {
  std::string name;  ///< letters, digits, _ and -
  Segmentation segmentation;
  std::optional<Place> place{};  ///< empty: the study's
  MethodFusion fusion{};
  Refinement refinement{};

  static void fields(auto& s, auto&& visit) {
    visit(s.segmentation, Field{.key = "segmentation",
                                .meaning = "from a detection and a registered cloud to points",
                                .required = true});
    visit(s.place, Field{"place", "as the study's `place`, for this method alone"});
    visit(s.fusion, Field{.key = "fusion",
                          .meaning = "how this method's observations change the map",
                          .later = true});
    visit(s.refinement, Field{.key = "refinement",
                              .meaning = "what happens to this method's map before it is scored",
                              .later = true});
  }
  bool operator==(const MethodSettings&) const = default;
};

}  // namespace mapscore::eval
