// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/segmentation.hpp"

#include <memory>
#include <vector>

namespace mapscore {

/// Adds a segmentation to the program that has a static object of it: a struct written as the kinds
/// of segmentation.hpp, with parameters that are double, int, bool or Degrees (docs/extending.md).
template <class Kind>
struct SegmentationPlugIn {
  SegmentationPlugIn() {
    PluggedSegmentation::plug_in(Kind::kKind, Kind::kMeaning, std::make_unique<Box>());
  }

 private:
  struct Box : PluggedBox<AnySegmentation, Kind, Box> {
    [[nodiscard]] std::vector<Segment> segment(const Sight& sight, double voxel_m,
                                               bool with_voxels) const override {
      check_ranges(this->kind_);
      return segments_of(this->kind_, sight, voxel_m, with_voxels);
    }
  };
};

}  // namespace mapscore
