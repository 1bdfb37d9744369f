// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/lab/frame_boxes.hpp"
#include "eval/lab/lattice_truth.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/recorded_surfaces.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/recording.hpp"

#include <cstddef>
#include <future>
#include <list>
#include <memory>
#include <mutex>

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

  /// The truth of a map of the selected frames.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> get(const MapFrame& map_frame,
                                                        const TruthOptions& options);
  /// As get, with every instance a class of its own (see instance_table) and without distances.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> of_instances(const MapFrame& map_frame,
                                                                 TruthOptions options);
  /// The truth of a frame by itself, at the stamp of the depth image that it is read with.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> of_frame(const MapFrame& map_frame,
                                                             TruthOptions options, int depth_image);
  /// As of_frame, with every instance a class of its own and without distances.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> of_frame_instances(const MapFrame& map_frame,
                                                                       TruthOptions options,
                                                                       int depth_image);
  /// What every trial compares its detections' boxes with; on no lattice.
  [[nodiscard]] FrameBoxes& boxes() { return boxes_; }

 private:
  using Truth = std::shared_ptr<const LatticeTruth>;
  using Surfaces = std::shared_ptr<const RecordedSurfaces>;
  /// What is made of a table's classes: surfaces by lattice, truths of maps and of single frames;
  /// each list with the most recently made first.
  struct Shelf {
    struct OfLattice {
      MapFrame map_frame;
      double epsilon_m;
      std::shared_future<Surfaces> surfaces;
    };
    struct OfView {
      MapFrame map_frame;
      TruthOptions options;
      std::shared_future<Truth> truth;
    };
    const ClassTable& table;
    std::list<OfLattice> surfaces{};
    std::list<OfView> maps{}, frames{};
  };

  [[nodiscard]] Truth get(Shelf& shelf, std::list<Shelf::OfView>& truths, std::size_t capacity,
                          const MapFrame& map_frame, const TruthOptions& options);
  [[nodiscard]] Surfaces surfaces(Shelf& shelf, const MapFrame& map_frame, double epsilon_m);
  [[nodiscard]] TruthOptions at_image(TruthOptions options, int depth_image) const;
  [[nodiscard]] const RecordedShapes& shapes();

  const Recording& recording_;
  ClassTable instance_table_;
  FrameCache& frames_;
  std::size_t capacity_;
  std::once_flag shapes_read_;
  RecordedShapes shapes_;
  std::mutex mutex_;  // guards the shelves' lists
  Shelf classes_, instances_;
  FrameBoxes boxes_;
};

}  // namespace mapscore::eval
