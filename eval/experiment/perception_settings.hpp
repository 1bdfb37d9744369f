// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mapscore::eval {

// Where the detections of a study come from; see study.hpp.

/// Label images of the recording.
struct LabelPerceptionSettings {
  static constexpr std::string_view kKind = "labels";
  static constexpr std::string_view kMeaning = "the recording's label images";
  bool operator==(const LabelPerceptionSettings&) const = default;
};

/// What simulated perception is told of the truth: a box about each instance, or about each of its
/// drawn surfaces.
enum class PerceivedBoxes { instances, surfaces };

/// Boxes of models, voted for by the depth image.
struct SimulatedPerceptionSettings {
  static constexpr std::string_view kKind = "simulated";
  static constexpr std::string_view kMeaning =
      "boxes in view, voted for by the points of the depth image (docs/objects.md)";
  std::optional<std::string> objects;  ///< empty: the recording's truth
  PerceivedBoxes boxes = PerceivedBoxes::instances;
  double tolerance_m = 0.01;
  int min_pixels = 1;
  bool operator==(const SimulatedPerceptionSettings&) const = default;
};

using PerceptionSettings = std::variant<LabelPerceptionSettings, SimulatedPerceptionSettings>;

}  // namespace mapscore::eval
