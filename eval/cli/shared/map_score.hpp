// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/report/table.hpp"
#include "eval/score/confusion.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "eval/score/instances/instance_score.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/score/occupancy_score.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags that say how a map's file is to be read.
struct MapFlags {
  std::string file, legend, transform;
  bool geometry = false, resample = false, skip_nan = false, trust_frame = false;

  void add_to(CLI::App& verb);
};

/// A map on the lattice of the truth.
struct InputMap {
  MapSnapshot snapshot{{}};
  std::vector<NumberedVoxel> numbers;  ///< of objects; empty where the file has none
  bool geometry = false;               ///< without classes: occupied voxels are of kSurfaceClass
  std::vector<Leftover> leftovers;     ///< labels that mean nothing
  std::vector<Leftover> unlisted;      ///< labels that the legend leaves to the truth's table
  std::string placing;                 ///< in words, how it came onto the lattice
};

/// Reads the map, gives its labels their meaning in `table` and brings it onto the lattice of edge
/// `edge_m`. Throws Error with where and how to mend it.
[[nodiscard]] InputMap read_input_map(const MapFlags& flags, const ClassTable& table,
                                      double edge_m);

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

/// Scores a map against a truth. Throws Error with the bounds of both when fewer than one occupied
/// voxel in a hundred lies on or beside a surface: then the map lies in another frame. Below one in
/// four it says so in a note. A map without occupied voxels passes.
[[nodiscard]] MapScore score_input(const InputMap& map, const MapFlags& flags, double threshold,
                                   TruthSource& source, int jobs);

/// The table that is always shown: by class, with the causes of every error.
[[nodiscard]] Table class_table(const MapScore& score);
/// What `--details` adds: distances, curve, instances, confusion, free space.
[[nodiscard]] std::vector<Table> detail_tables(const MapScore& score);
/// All of it, one row a class and metric: class,metric,value.
[[nodiscard]] Table tidy_table(const MapScore& score);

/// Tables with the same columns as one: the rows of each first cell, such as a class, stand
/// together, in the tables' order, with a column `map` of their names; of equal lines of captions
/// one is kept.
[[nodiscard]] Table tables_beside(const std::vector<std::string>& names,
                                  const std::vector<Table>& tables);

/// Labelled images against the recording's: by class, and the confusion matrix.
[[nodiscard]] std::vector<Table> label_tables(const ConfusionMatrix& matrix,
                                              const ClassTable& table);
[[nodiscard]] Table tidy_label_table(const ConfusionMatrix& matrix, const ClassTable& table);

}  // namespace mapscore::eval
