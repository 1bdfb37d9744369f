// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/map_input.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/report/table.hpp"
#include "eval/score/confusion.hpp"
#include "eval/score/instances/instance_score.hpp"
#include "eval/score/occupancy_score.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Everything that is counted of one map.
struct MapScore {
  ClassTable table;  ///< of the truth, or its geometry_table
  LatticeTruth truth;
  double threshold = 0.0;
  bool sampled = true;  ///< the truth has depth samples, so that completeness is defined
  Counts counts;
  ConfusionMatrix confusion;
  std::vector<InstanceCounts> instances;     ///< by class id; empty for geometry alone
  std::optional<OccupancyCounts> occupancy;  ///< where a recording's map knows free voxels
  std::string note;                          ///< for the user, on where the map lies; often empty
};

/// Scores a map against a truth. Throws Error when the map lies in another frame.
[[nodiscard]] MapScore score_input(const InputMap& map, const MapFlags& flags, double threshold,
                                   TruthSource& source, int jobs);

/// The table that is always shown: by class, with the causes of every error.
[[nodiscard]] Table class_table(const MapScore& score);
/// What `--details` adds: distances, curve, instances, confusion, free space.
[[nodiscard]] std::vector<Table> detail_tables(const MapScore& score);
/// All of it, one row a class and metric: class,metric,value.
[[nodiscard]] Table tidy_table(const MapScore& score);

/// Labelled images against the recording's: by class, and the confusion matrix.
[[nodiscard]] std::vector<Table> label_tables(const ConfusionMatrix& matrix,
                                              const ClassTable& table);
[[nodiscard]] Table tidy_label_table(const ConfusionMatrix& matrix, const ClassTable& table);

}  // namespace mapscore::eval
