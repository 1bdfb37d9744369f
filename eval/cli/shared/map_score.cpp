// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/map_score.hpp"

#include "eval/score/reduced_tables.hpp"

namespace mapscore::eval {
namespace {

/// The table with the predicted classes detected too, so that samples of them are kept.
ClassTable sampled_table(const ClassTable& table, const MapSnapshot& map) {
  ClassTable sampled = table;
  for (const MapVoxel& voxel : map.voxels())
    if (voxel.best_class != kBackground) sampled.classes.at(voxel.best_class).detect = true;
  return sampled;
}

std::vector<InstanceCounts> instances_of(const InputMap& map, double threshold,
                                         TruthSource& source) {
  const LatticeTruth truth = source.truth(instance_table(source.table()), false);
  const PredictedInstances predicted = map.numbers.empty()
                                           ? pieces_of(map.snapshot, threshold)
                                           : objects_of(map.snapshot, threshold, map.numbers);
  return score_instances(predicted, truth.surface, truth.view.visible, source.table());
}

}  // namespace

MapScore score_input(const InputMap& map, const MapFlags& flags, double threshold,
                     TruthSource& source, int jobs) {
  MapScore score;
  score.table = map.geometry ? geometry_table(source.table()) : source.table();
  score.threshold = threshold;
  score.sampled = source.recording() != nullptr;
  score.truth = source.truth(sampled_table(score.table, map.snapshot), true);
  score.note = check_frame(flags, map.snapshot, score.truth.surface);
  const ViewTruth& view = score.truth.view;
  const std::size_t classes = score.table.classes.size();
  score.counts = score.truth.score(map.snapshot, threshold, view, classes, {}, jobs);
  score.confusion =
      confusion_of(map.snapshot, threshold, score.truth.surface, view.visible, classes);
  if (!map.geometry) score.instances = instances_of(map, threshold, source);
  if (source.recording() && carves(map.snapshot))
    score.occupancy =
        score_occupancy(map.snapshot, source.occupancy(score.truth.surface), score.truth.surface);
  return score;
}

}  // namespace mapscore::eval
