// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Noise-free depth samples of each class in the map frame, grouped by the voxel that they lie in.
/// Made once for a recording, lattice and set of frames, and shared by all trials scored against
/// it. Immutable, safe to share between threads. Keeps 12 bytes a sample: single-precision offsets
/// from the voxel's centre, which are off by at most 2 nm at 5 cm.
class SampleSet {
 public:
  /// All samples of one class in one voxel.
  struct Group {
    VoxelKey key;
    std::size_t first = 0, count = 0;
  };

  SampleSet() = default;
  /// `points_by_class[c]`: p_map of the samples of class c, metres; `edge_m` > 0: edge of the
  /// lattice.
  SampleSet(std::span<const std::vector<Eigen::Vector3d>> points_by_class, double edge_m);

  [[nodiscard]] double edge_m() const { return edge_m_; }
  [[nodiscard]] std::size_t class_count() const { return classes_.size(); }
  /// Groups of a class, ordered by key.
  [[nodiscard]] std::span<const Group> groups(ClassId class_id) const {
    return classes_[class_id].groups;
  }
  /// Samples of a group of that class, metres from the centre of its voxel.
  [[nodiscard]] std::span<const Eigen::Vector3f> offsets(ClassId class_id,
                                                         const Group& group) const {
    return std::span(classes_[class_id].offsets).subspan(group.first, group.count);
  }
  [[nodiscard]] std::size_t sample_count(ClassId class_id) const {
    return classes_[class_id].offsets.size();
  }

 private:
  struct ClassSamples {
    std::vector<Group> groups;
    std::vector<Eigen::Vector3f> offsets;
  };
  static ClassSamples grouped(std::span<const Eigen::Vector3d> points, double edge_m);

  double edge_m_ = 0.0;
  std::vector<ClassSamples> classes_;
};

}  // namespace mapscore::eval
