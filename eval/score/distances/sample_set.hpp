// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace mapscore::eval {

class SampleCollector;

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

 private:
  friend class SampleCollector;
  struct ClassSamples {
    std::vector<Group> groups;
    std::vector<Eigen::Vector3f> offsets;
  };

  double edge_m_ = 0.0;
  std::vector<ClassSamples> classes_;
};

/// Samples on their way into a SampleSet, 12 bytes each and 32 for each run of neighbours in one
/// voxel. Not thread-safe: one per thread, appended in the order of the frames, so that the set
/// does not depend on how many there were.
class SampleCollector {
 public:
  /// `edge_m` > 0: edge of the lattice.
  SampleCollector(std::size_t class_count, double edge_m)
      : edge_m_(edge_m), classes_(class_count) {}

  /// `class_id` below the number of classes; p_map in metres, within 2^20 voxels of the origin.
  void add(ClassId class_id, const Eigen::Vector3d& p_map);
  /// Moves the samples of another collector of the same classes and lattice behind these.
  void append(SampleCollector&& later);
  /// All samples by voxel, each voxel's in the order in which they came. Leaves nothing behind.
  /// Works on `jobs` threads, a class at a time each.
  [[nodiscard]] SampleSet take(int jobs = 1);

 private:
  /// Still in the order of arrival: a voxel may have several groups.
  using ClassSamples = SampleSet::ClassSamples;
  [[nodiscard]] static ClassSamples grouped(ClassSamples&& runs);

  double edge_m_;
  std::vector<ClassSamples> classes_;
};

}  // namespace mapscore::eval
