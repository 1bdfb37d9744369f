// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_association.hpp"

#include <algorithm>
#include <tuple>

namespace mapscore {
namespace {

struct Pair {
  double distance_m;
  std::size_t object, detection;
};

bool passes(const ObjectBox& a, const ObjectBox& b, double distance_m,
            const AssociationGate& gate) {
  return distance_m <= gate.max_distance_m ||
         overlap_share(a.widened(gate.margin_m), b.widened(gate.margin_m)) >= gate.min_overlap;
}

}  // namespace

std::vector<std::optional<std::size_t>> associate(std::span<const ObjectDetection> detections,
                                                  std::span<const MapObject> objects,
                                                  const AssociationGate& gate) {
  std::vector<Pair> pairs;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (detections[d].class_id != objects[o].class_id) continue;
      const ObjectBox &seen = detections[d].box, &known = objects[o].box;
      const double distance_m = (seen.centre() - known.centre()).norm();
      if (passes(seen, known, distance_m, gate)) pairs.push_back({distance_m, o, d});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.object, a.detection) <
           std::tie(b.distance_m, b.object, b.detection);
  });
  std::vector<std::optional<std::size_t>> object_of(detections.size());
  std::vector<bool> taken(objects.size());
  for (const Pair& pair : pairs) {
    if (object_of[pair.detection] || taken[pair.object]) continue;
    object_of[pair.detection] = pair.object;
    taken[pair.object] = true;
  }
  return object_of;
}

}  // namespace mapscore
