// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/map_score.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/frame_check.hpp"
#include "eval/map_files/lattice_map.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/map_files/map_transform.hpp"
#include "eval/score/reduced_tables.hpp"
#include "eval/score/voxel_score.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <filesystem>

namespace mapscore::eval {
namespace {

std::string words_of(Placing placing, double file_edge_m, bool is_moved) {
  const std::string from =
      file_edge_m > 0.0 ? fmt::format("voxels of {} m", file_edge_m) : std::string("its voxels");
  const char* moved = is_moved ? " moved and" : "";
  if (placing == Placing::pulled)
    return fmt::format("{}{} read at the centres of the truth's", from, moved);
  if (placing == Placing::pushed)
    return fmt::format("{}{} put into the truth's by their centres", from, moved);
  return placing == Placing::binned ? fmt::format("points{} binned", moved) : std::string();
}

/// The table with the predicted classes detected too, so that samples of them are kept.
ClassTable sampled_table(const ClassTable& table, const MapSnapshot& map) {
  ClassTable sampled = table;
  for (const MapVoxel& voxel : map.voxels())
    if (voxel.best_class != kBackground) sampled.classes.at(voxel.best_class).detect = true;
  return sampled;
}

std::vector<InstanceCounts> instances_of(const InputMap& map, double threshold,
                                         TruthSource& source) {
  const auto truth = source.kept_truth(instance_table(source.table()), false);
  const PredictedInstances predicted = map.numbers.empty()
                                           ? pieces_of(map.snapshot, threshold)
                                           : objects_of(map.snapshot, threshold, map.numbers);
  return score_instances(predicted, truth->surface, truth->view.visible, source.table());
}

}  // namespace

void MapFlags::add_to(CLI::App& verb) {
  verb.add_option("--legend", legend, "YAML: what the map's colours, ids and names mean");
  verb.add_flag("--geometry", geometry, "Leave labels out: score where something is, not what");
  verb.add_option("--transform", transform,
                  "T_map_file: a file, or in quotes, with tx ty tz qx qy qz qw or a 4x4 matrix");
  verb.add_option("--scale", scale, "Metres in a unit of the map: 0.001 for millimetres [1]")
      ->check(finite_within(1e-6, 1e6));
  verb.add_flag("--resample", resample, "Bring voxels of another edge onto the lattice");
  verb.add_flag("--skip_nan", skip_nan, "Leave out points with coordinates that are not finite");
  verb.add_flag("--trust_frame", trust_frame, "Score a map that seems to lie in another frame");
}

Pose MapFlags::T_map_file() const {
  if (transform.empty()) return Pose::Identity();
  if (std::filesystem::exists(transform)) return read_transform(transform);
  if (transform.find_first_not_of("0123456789+-.eE, \t\n") != std::string::npos)
    throw Error(transform +
                ": no such file; --transform takes a file, or its 7 or 16 numbers in quotes");
  return parse_transform(transform, "--transform");
}

LabelledMap read_labelled_map(const MapFlags& flags, const ClassTable& table) {
  LabelledMap map;
  map.file = read_map_file(flags.file, flags.skip_nan ? NotFinite::skip : NotFinite::refuse);
  if (flags.scale != 1.0 && map.file.points.empty() && map.file.edge_m == 0.0)
    throw Error(flags.file + ": --scale: voxels by their indices have no unit; leave it out");
  map.file.edge_m *= flags.scale;
  for (Eigen::Vector3d& point : map.file.points) point *= flags.scale;
  map.geometry = flags.geometry || map.file.label_kind == LabelKind::none;
  if (flags.geometry && !flags.legend.empty())
    throw Error("--legend: --geometry leaves the labels out; give one of the two");
  if (map.geometry && !flags.legend.empty())
    throw Error(flags.file + ": has no labels that --legend could explain; leave it out");
  std::optional<Legend> legend;
  if (!flags.legend.empty()) legend = read_legend(flags.legend, table);
  try {
    if (map.geometry)
      map.labelling.classes.assign(map.file.size(), kSurfaceClass);
    else
      map.labelling = apply_legend(map.file, legend, table);
  } catch (const Error& error) {
    throw Error(flags.file + ": " + error.what());
  }
  return map;
}

InputMap placed(const LabelledMap& map, const MapFlags& flags, const Pose& T_map_file,
                double edge_m) {
  InputMap input;
  input.geometry = map.geometry;
  input.T_map_file = T_map_file;
  for (const Eigen::Vector3d& p : map.file.points) input.bounds.extend(T_map_file * p);
  try {
    LatticeMap lattice = on_lattice(map.file, map.labelling.classes, T_map_file, edge_m,
                                    flags.resample ? Resample::allow : Resample::refuse);
    for (std::size_t n = 0; n < lattice.instances.size(); ++n)
      input.numbers.push_back({lattice.voxels[n].key, lattice.instances[n]});
    input.placing =
        words_of(lattice.placing, map.file.edge_m, !T_map_file.isApprox(Pose::Identity(), 0.0));
    input.snapshot = MapSnapshot(std::move(lattice.voxels));
  } catch (const Error& error) {
    throw Error(flags.file + ": " + error.what());
  }
  return input;
}

MapScore score_input(const InputMap& map, const MapFlags& flags, double threshold,
                     TruthSource& source, int jobs) {
  MapScore score;
  score.table = map.geometry ? geometry_table(source.table()) : source.table();
  score.threshold = threshold;
  score.sampled = source.recording() != nullptr;
  score.truth = source.kept_truth(sampled_table(score.table, map.snapshot), true);
  const SurfaceTruth& surface = score.truth->surface;
  if (!flags.trust_frame) score.note = frame_note(flags, map, surface, source);
  const ViewTruth& view = score.truth->view;
  const std::size_t classes = score.table.classes.size();
  score.counts = score.truth->score(map.snapshot, threshold, view, classes, {}, jobs);
  score.confusion = confusion_of(map.snapshot, threshold, surface, view.visible, classes);
  if (!map.geometry) score.instances = instances_of(map, threshold, source);
  if (source.recording() && carves(map.snapshot))
    score.occupancy = score_occupancy(map.snapshot, source.occupancy(surface), surface);
  return score;
}

}  // namespace mapscore::eval
