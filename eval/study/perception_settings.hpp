// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mapscore::eval {

/// Detections come from the label images of the recording.
struct LabelPerception {
  static constexpr std::string_view kKind = "labels";
  static constexpr std::string_view kMeaning = "the recording's label images";

  static void fields(auto&, auto&&) {}
  bool operator==(const LabelPerception&) const = default;
};

/// What simulated perception knows of the truth: a box about each instance, or about each of its
/// drawn surfaces.
enum class PerceivedBoxes { instances, surfaces };
constexpr auto names_of(PerceivedBoxes) {
  return std::to_array<std::string_view>({"instances", "surfaces"});
}

/// Boxes of models, voted for by the depth image.
struct SimulatedPerception {
  static constexpr std::string_view kKind = "simulated";
  static constexpr std::string_view kMeaning =
      "boxes in view, voted for by the points of the depth image (docs/objects.md)";
  std::optional<std::string> objects;  ///< empty: the recording's truth
  PerceivedBoxes boxes = PerceivedBoxes::instances;
  double tolerance_m = 0.01;
  int min_pixels = 1;

  static void fields(auto& s, auto&& visit) {
    visit(s.objects,
          Field{"objects",
                "object map (YAML) whose boxes are perceived, from the study file's folder; "
                "default: the recording's truth"});
    visit(s.boxes, Field{"boxes",
                         "of the truth: one about each instance, along the axes of the scene's "
                         "world, or one about each of its drawn surfaces, along the surface's"});
    visit(s.tolerance_m, Field{"tolerance_m", "widening of the boxes on each side", {0, 1}});
    visit(s.min_pixels, Field{"min_pixels", "depth pixels that make an object seen", {1, 1000000}});
  }
  bool operator==(const SimulatedPerception&) const = default;
};

/// Where the detections of a study come from.
using PerceptionSettings = std::variant<LabelPerception, SimulatedPerception>;

}  // namespace mapscore::eval
