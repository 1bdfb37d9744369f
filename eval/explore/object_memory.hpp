// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/placement/pose_belief.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/lab/object_run.hpp"

#include <cstddef>
#include <set>
#include <vector>

namespace mapscore::eval {

/// The objects that a robot has met on its way, as [N] keeps them (docs/objects.md), and which of
/// them are to be looked for again: those that should have been seen since their last detection,
/// by the boxes and the depth image, and were not. Used by one thread at a time.
class ObjectMemory {
 public:
  /// `priority_voxels`: what a look at such an object is worth.
  ObjectMemory(std::size_t class_count, double priority_voxels)
      : map_(class_count, ObjectRunOptions{}.map), priority_voxels_(priority_voxels) {}

  /// Takes in what one frame's segments say.
  void add(const std::vector<Segment>& segments, const Sight& sight, const PoseBelief& belief,
           double stamp_s);

  /// Centres of those that are missed now, frame map, ascending by id.
  [[nodiscard]] std::vector<LookAgain> again() const;
  [[nodiscard]] std::size_t objects() const { return map_.objects().size(); }
  /// Objects that were missed at some time, and those of them that were detected again later.
  [[nodiscard]] std::size_t missed() const { return missed_.size(); }
  [[nodiscard]] std::size_t found_again() const { return found_again_.size(); }

 private:
  ObjectMap map_;
  double priority_voxels_;
  std::set<ObjectId> missed_, found_again_;
};

}  // namespace mapscore::eval
