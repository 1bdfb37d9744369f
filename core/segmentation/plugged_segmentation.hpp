// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/plugged.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/sight.hpp"

#include <vector>

namespace mapscore {

/// What every segmentation does.
class AnySegmentation {
 public:
  virtual ~AnySegmentation() = default;
  /// As `segment` of segmentation.hpp.
  [[nodiscard]] virtual std::vector<Segment> segment(const Sight& sight, double voxel_m,
                                                     bool with_voxels) const = 0;
};

/// The segmentation that a program adds (docs/extending.md).
class PluggedSegmentation : public Plugged<AnySegmentation> {
 public:
  /// Throws Error also when the segments are not those of the detections, one each and in their
  /// order, or hold a point that is not finite.
  [[nodiscard]] std::vector<Segment> segment(const Sight& sight, double voxel_m,
                                             bool with_voxels) const;
};

}  // namespace mapscore
