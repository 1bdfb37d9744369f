// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/map_score.hpp"

#include "core/error.hpp"
#include "eval/map_files/lattice_map.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/map_files/map_transform.hpp"
#include "eval/score/reduced_tables.hpp"
#include "eval/score/surface_share.hpp"
#include "eval/score/voxel_score.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <filesystem>

namespace mapscore::eval {
namespace {

/// Below it a map is more likely turned or shifted than bad.
constexpr double kDoubtfulShareAtSurfaces = 0.25;

Pose transform_of(const std::string& text) {
  if (text.empty()) return Pose::Identity();
  if (std::filesystem::exists(text)) return read_transform(text);
  if (text.find_first_not_of("0123456789+-.eE, \t\n") != std::string::npos)
    throw Error(text +
                ": no such file; --transform takes a file, or its 7 or 16 numbers in quotes");
  return parse_transform(text, "--transform");
}

std::string span_of(const Eigen::AlignedBox3d& box) {
  return fmt::format("x {:.2f}..{:.2f} y {:.2f}..{:.2f} z {:.2f}..{:.2f} m", box.min().x(),
                     box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z());
}

std::string words_of(Placing placing, double file_edge_m, bool is_moved) {
  const std::string from =
      file_edge_m > 0.0 ? fmt::format("voxels of {} m", file_edge_m) : std::string("its voxels");
  const char* moved = is_moved ? " moved by --transform and" : "";
  if (placing == Placing::pulled)
    return fmt::format("{}{} read at the centres of the truth's", from, moved);
  if (placing == Placing::pushed)
    return fmt::format("{}{} put into the truth's by their centres", from, moved);
  return placing == Placing::binned ? fmt::format("points{} binned", moved) : std::string();
}

/// The note of score_input() on where the map lies, or its Error.
std::string check_frame(const MapFlags& flags, const MapSnapshot& map,
                        const SurfaceTruth& surface) {
  if (flags.trust_frame) return {};
  const SurfaceShare at = surface_share(map, surface);
  if (at.share() >= kDoubtfulShareAtSurfaces) return {};
  if (!at.in_another_frame())
    return fmt::format(
        "only {:.0f} % of the map's occupied voxels lie on or beside a surface; is it in the frame "
        "that --transform, --origin_m and --yaw_deg say?",
        100.0 * at.share());
  Eigen::AlignedBox3d map_box, truth_box;
  for (const MapVoxel& voxel : map.voxels())
    if (voxel.occupied) map_box.extend(centre_of(voxel.key, surface.edge_m()));
  for (const SurfaceVoxel& row : surface.voxels())
    truth_box.extend(centre_of(row.key, surface.edge_m()));
  throw Error(fmt::format(
      "{}: only {} of {} occupied voxels lie on or beside a surface, so the map seems to lie in "
      "another frame (map {}; truth {}); give --transform, --origin_m or --yaw_deg, or score it "
      "as it is with --trust_frame",
      flags.file, at.at_surfaces, at.occupied, span_of(map_box),
      surface.voxels().empty() ? "empty" : span_of(truth_box)));
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
  const LatticeTruth truth = source.truth(instance_table(source.table()), false);
  const PredictedInstances predicted = map.numbers.empty()
                                           ? pieces_of(map.snapshot, threshold)
                                           : objects_of(map.snapshot, threshold, map.numbers);
  return score_instances(predicted, truth.surface, truth.view.visible, source.table());
}

}  // namespace

void MapFlags::add_to(CLI::App& verb) {
  verb.add_option("--legend", legend, "YAML: what the map's colours, ids and names mean");
  verb.add_flag("--geometry", geometry, "Leave labels out: score where something is, not what");
  verb.add_option("--transform", transform,
                  "T_map_file: a file, or in quotes, with tx ty tz qx qy qz qw or a 4x4 matrix");
  verb.add_flag("--resample", resample, "Bring voxels of another edge onto the lattice");
  verb.add_flag("--skip_nan", skip_nan, "Leave out points with coordinates that are not finite");
  verb.add_flag("--trust_frame", trust_frame, "Score a map that seems to lie in another frame");
}

InputMap read_input_map(const MapFlags& flags, const ClassTable& table, double edge_m) {
  const MapFile file =
      read_map_file(flags.file, flags.skip_nan ? NotFinite::skip : NotFinite::refuse);
  InputMap map;
  map.geometry = flags.geometry || file.label_kind == LabelKind::none;
  if (flags.geometry && !flags.legend.empty())
    throw Error("--legend: --geometry leaves the labels out; give one of the two");
  if (map.geometry && !flags.legend.empty())
    throw Error(flags.file + ": has no labels that --legend could explain; leave it out");
  std::optional<Legend> legend;
  if (!flags.legend.empty()) legend = read_legend(flags.legend, table);
  try {
    Labelling labelling = map.geometry
                              ? Labelling{std::vector<ClassId>(file.size(), kSurfaceClass), {}, {}}
                              : apply_legend(file, legend, table);
    map.leftovers = std::move(labelling.leftovers);
    map.unlisted = std::move(labelling.unlisted);
    LatticeMap lattice = on_lattice(file, labelling.classes, transform_of(flags.transform), edge_m,
                                    flags.resample ? Resample::allow : Resample::refuse);
    for (std::size_t n = 0; n < lattice.instances.size(); ++n)
      map.numbers.push_back({lattice.voxels[n].key, lattice.instances[n]});
    map.placing = words_of(lattice.placing, file.edge_m, !flags.transform.empty());
    map.snapshot = MapSnapshot(std::move(lattice.voxels));
  } catch (const Error& error) {
    throw Error(flags.file + ": " + error.what());
  }
  return map;
}

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
