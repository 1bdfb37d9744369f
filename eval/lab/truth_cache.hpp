// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/lattice_truth.hpp"
#include "eval/lab/shared_cache.hpp"
#include "eval/recording/frame_cache.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Makes the truths of a recording's lattices on demand and keeps the latest: `capacity` of each
/// kind, of single frames kFramesOfLattice times as many. Safe to use from several threads: a
/// thread that asks for a truth that another one is making waits for it.
class TruthCache {
 public:
  static constexpr std::size_t kFramesOfLattice = 16;
  /// Least number of lattices whose surfaces are kept: each block of frames needs them again, and
  /// they take little memory compared with the frames.
  static constexpr std::size_t kLeastLattices = 16;

  TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
             std::size_t capacity);

  /// The truth of a map of the selected frames; or of one frame by itself, where the options name
  /// the depth image that it is read with, at the stamp of that image.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> get(const MapFrame& map_frame,
                                                        const TruthOptions& options);
  /// As get, with every instance a class of its own (see instance_table) and without distances.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> of_instances(const MapFrame& map_frame,
                                                                 TruthOptions options);
  /// True boxes of the instances in a frame's depth image, by instance id, as truth_boxes gives
  /// them; on no lattice. They depend on no trial, so they are made by the first that asks; valid
  /// as long as this. Throws Error when the frame lacks depth or depth_label.
  [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& boxes_of(const Frame& frame);

 private:
  using Truth = std::shared_ptr<const LatticeTruth>;
  using Surfaces = std::shared_ptr<const RecordedSurfaces>;
  /// What is made of a table's classes: surfaces by lattice and epsilon, truths of maps and of
  /// single frames.
  struct Shelf {
    Shelf(const ClassTable& classes, std::size_t capacity);

    const ClassTable& table;
    SharedCache<std::pair<MapFrame, double>, Surfaces> surfaces;
    SharedCache<std::pair<MapFrame, TruthOptions>, Truth> maps, frames;
  };
  struct FrameBoxes {
    std::once_flag made;
    std::vector<Eigen::AlignedBox3d> boxes;
  };

  [[nodiscard]] Truth get(Shelf& shelf, const MapFrame& map_frame, TruthOptions options);
  [[nodiscard]] Surfaces surfaces(Shelf& shelf, const MapFrame& map_frame, double epsilon_m);

  const Recording& recording_;
  ClassTable instance_table_;
  FrameCache& frames_;
  std::once_flag shapes_read_;
  RecordedShapes shapes_;
  Shelf classes_, instances_;
  std::vector<FrameBoxes> boxes_;  ///< by depth image
};

}  // namespace mapscore::eval
