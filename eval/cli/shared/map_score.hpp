// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/report/tables/table.hpp"
#include "eval/score/confusion.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "eval/score/instances/instance_score.hpp"
#include "eval/score/label_images.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/score/occupancy_score.hpp"

#include <CLI/CLI.hpp>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags that say how a map's file is to be read.
struct MapFlags {
  std::string file, legend, transform;
  double scale = 1.0;  ///< metres in a unit of the file
  bool geometry = false, resample = false, skip_nan = false, trust_frame = false;

  void add_to(CLI::App& verb);
  /// What --transform says. Throws Error.
  [[nodiscard]] Pose T_map_file() const;
};

/// A map as its file holds it, in metres, with the class of each element.
struct LabelledMap {
  MapFile file;
  Labelling labelling;
  bool geometry = false;  ///< without classes: all elements are of kSurfaceClass
};

/// Reads the map and gives its labels their meaning in `table`. Throws Error with where and how to
/// mend it.
[[nodiscard]] LabelledMap read_labelled_map(const MapFlags& flags, const ClassTable& table);

/// A map on the lattice of the truth.
struct InputMap {
  MapSnapshot snapshot{{}};
  std::vector<NumberedVoxel> numbers;  ///< of objects; empty where the file has none
  bool geometry = false;               ///< without classes: occupied voxels are of kSurfaceClass
  Pose T_map_file = Pose::Identity();
  Eigen::AlignedBox3d bounds;  ///< of a cloud's points, before they were binned
  std::string placing;         ///< in words, how it came onto the lattice
};

/// Brings the map onto the lattice of edge `edge_m`. Throws Error as on_lattice.
[[nodiscard]] InputMap placed(const LabelledMap& map, const MapFlags& flags, const Pose& T_map_file,
                              double edge_m);

/// Everything that is counted of one map.
struct MapScore {
  ClassTable table;  ///< of the truth, or its geometry_table
  std::shared_ptr<const LatticeTruth> truth;
  double threshold = 0.0;
  bool sampled = true;  ///< the truth has depth samples, so that completeness is defined
  Counts counts;
  ConfusionMatrix confusion;
  std::vector<InstanceCounts> instances;     ///< by class id; empty for geometry alone
  std::optional<OccupancyCounts> occupancy;  ///< where a recording's map knows free voxels
  std::string note;                          ///< for the user, on where the map lies; often empty
};

/// Scores a map against a truth. Throws Error as frame_note unless --trust_frame is given.
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
[[nodiscard]] std::vector<Table> label_tables(const LabelComparison& score,
                                              const ClassTable& table);
[[nodiscard]] Table tidy_label_table(const LabelComparison& score, const ClassTable& table);

}  // namespace mapscore::eval
