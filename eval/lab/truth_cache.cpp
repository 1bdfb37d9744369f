// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/truth_cache.hpp"

#include "eval/score/box_score.hpp"
#include "eval/score/reduced_tables.hpp"

#include <algorithm>

namespace mapscore::eval {
namespace {

constexpr int kOneJob = 1;  // the threads that ask are the parallelism

}  // namespace

TruthCache::Shelf::Shelf(const ClassTable& classes, std::size_t capacity)
    : table(classes),
      surfaces(std::max(capacity, kLeastLattices)),
      maps(capacity),
      frames(capacity * kFramesOfLattice) {}

TruthCache::TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
                       std::size_t capacity)
    : recording_(recording),
      instance_table_(instance_table(table)),
      frames_(frames),
      classes_(table, capacity),
      instances_(instance_table_, capacity),
      boxes_(static_cast<std::size_t>(recording.depth_count())) {}

TruthCache::Truth TruthCache::get(const MapFrame& map_frame, const TruthOptions& options) {
  return get(classes_, map_frame, options);
}

TruthCache::Truth TruthCache::of_instances(const MapFrame& map_frame, TruthOptions options) {
  options.distances = false;
  return get(instances_, map_frame, options);
}

TruthCache::Truth TruthCache::get(Shelf& shelf, const MapFrame& map_frame, TruthOptions options) {
  if (options.depth_image) options.at_s = recording_.depth_stamp_s(*options.depth_image);
  auto& truths = options.depth_image ? shelf.frames : shelf.maps;
  return truths.get({map_frame, options}, [&] {
    LatticeTruth truth{surfaces(shelf, map_frame, options.epsilon_m)->at(options.at_s), {}};
    truth.view =
        make_view(recording_, shelf.table, frames_, map_frame, options, truth.surface, kOneJob);
    return std::make_shared<const LatticeTruth>(std::move(truth));
  });
}

TruthCache::Surfaces TruthCache::surfaces(Shelf& shelf, const MapFrame& map_frame,
                                          double epsilon_m) {
  return shelf.surfaces.get({map_frame, epsilon_m}, [&] {
    std::call_once(shapes_read_, [this] { shapes_ = shapes_of(recording_); });
    return std::make_shared<const RecordedSurfaces>(shapes_, shelf.table, map_frame, epsilon_m,
                                                    kOneJob);
  });
}

const std::vector<Eigen::AlignedBox3d>& TruthCache::boxes_of(const Frame& frame) {
  FrameBoxes& entry = boxes_.at(static_cast<std::size_t>(frame.depth_index));
  const RecordingInfo& info = recording_.info();
  std::call_once(entry.made, [&] {
    entry.boxes = truth_boxes(frame, info.calibration, info.table.instances.size());
  });
  return entry.boxes;
}

}  // namespace mapscore::eval
