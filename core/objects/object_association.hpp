// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/objects/map_object.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mapscore {

/// When a detection may be an object of the map: same class, and centres within `max_distance_m` or
/// boxes that share `min_overlap` of the smaller one, each widened by `margin_m` on every side, so
/// that flat boxes have a volume.
struct AssociationGate {
  double max_distance_m = 0.05;
  double min_overlap = 0.25;
  double margin_m = 0.025;
};

/// Position in `objects` of each detection's object, or nothing. Pairs that pass the gate are taken
/// from the least distance of centres on, each detection and each object once; ties go to the
/// earlier object, then the earlier detection.
[[nodiscard]] std::vector<std::optional<std::size_t>> associate(
    std::span<const ObjectDetection> detections, std::span<const MapObject> objects,
    const AssociationGate& gate);

}  // namespace mapscore
