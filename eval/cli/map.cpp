// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/map_flags.hpp"
#include "eval/cli/map_poses.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/folder_mapping.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/map_files/clouds/cloud_file.hpp"
#include "eval/results/study_store.hpp"
#include "eval/score/map_snapshot.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <numbers>
#include <optional>

namespace mapscore::eval {
namespace {

/// The study's method by name, its first without one.
const MethodSettings& method_of(const Study& study, const std::string& name) {
  std::string names;
  for (const MethodSettings& method : study.methods) {
    if (name.empty() || method.name == name) return method;
    names += " " + method.name;
  }
  throw Error(fmt::format("--method: no method '{}' in the study; methods:{}", name, names));
}

/// The study that the flags name, if they do.
std::optional<Study> study_of(const MapVerbFlags& flags) {
  if (!flags.study.empty()) {
    Study study = load_study(flags.study, flags.overrides);
    check_keys(study, flags);
    return study;
  }
  if (!flags.method.empty())
    throw Error("--method: names a method of a study; give --study, or --segmentation");
  if (!flags.overrides.empty())
    throw Error("--set: changes a key of a study; give --study, or the flags of this verb");
  return std::nullopt;
}

/// What a folder cannot do as a trial does it.
void check_mappable(const Study& study, const MethodSettings& method) {
  if (method.command)
    throw Error(
        fmt::format("--method {}: is a command; take a method of ours, or `sweep`", method.name));
  if (!std::holds_alternative<LabelPerception>(study.perception))
    throw Error("perception: `map` takes the folder's labels; leave the key out, or use `run`");
  const auto* crf = std::get_if<Crf>(&method.refinement);
  if (crf != nullptr && crf->reads_colour())
    throw Error(
        fmt::format("methods.{0}.refinement.crf.appearance_weight: `map` reads no colours; --set "
                    "methods.{0}.refinement.crf.appearance_weight=0, or use `run`",
                    method.name));
}

FolderMapping folder_mapping(const std::optional<Study>& study, const MapVerbFlags& flags,
                             const ClassTable& table) {
  FolderMapping mapping;
  if (study) {
    const MethodSettings& method = method_of(*study, flags.method);
    check_mappable(*study, method);
    mapping.mapping = mapping_of(with_method(*study, method.name), table);
    mapping.mapping.fusion.draws = {};  // a pose that is known is drawn once
    mapping.refinement = method.refinement;
  }
  if (!study || flags.segmentation.given())
    mapping.mapping.segmentation = flags.segmentation.value();
  if (!study || flags.mapped.given()) mapping.mapping.frames = flags.mapped.value();
  if (flags.voxel_m) mapping.mapping.voxel_m = *flags.voxel_m;
  if (flags.K) {
    auto* blend = std::get_if<BlendRule>(&mapping.mapping.fusion.rule);
    if (blend == nullptr)
      throw Error("--K: is the blend's, and the study fuses by another rule; leave it out");
    blend->K = *flags.K;
  }
  mapping.T_map_world =
      map_from_world({flags.origin_m.at(0), flags.origin_m.at(1), flags.origin_m.at(2)},
                     flags.yaw_deg * std::numbers::pi / 180.0);
  return mapping;
}

std::string counts_text(const LabelledFolderCounts& labels, const MappedCounts& counts) {
  std::string text =
      fmt::format("{} of {} label images mapped", counts.frames - counts.left_out, labels.labels);
  if (counts.left_out > 0) text += fmt::format("; {} left out as no key frames", counts.left_out);
  if (labels.no_depth > 0)
    text += fmt::format("; {} without a depth image near in time", labels.no_depth);
  if (labels.no_pose > 0) text += fmt::format("; {} without a pose", labels.no_pose);
  if (counts.hits_beyond_span > 0)
    text += fmt::format("; {} hits left out, farther from the map's origin than an octree reaches",
                        counts.hits_beyond_span);
  text += fmt::format("\n{} detections, {} of them without points; {} points kept\n",
                      counts.detections, counts.empty, counts.points);
  if (counts.unsure > 0)
    text += fmt::format(
        "{} of {} frames: mended with a confidence below 0.5; see with `mapscore calibrate` "
        "whether depth lies to the labels as believed\n",
        counts.unsure, counts.frames);
  return text;
}

std::string class_lines(const SemanticMap& map, const ClassTable& table, double threshold) {
  std::vector<std::int64_t> voxels(table.classes.size());
  for (const MapVoxel& voxel : map.voxels())
    if (predicted(voxel, threshold)) ++voxels.at(voxel.best_class);
  std::string text = fmt::format("{:<6} {:<20} {:>10}\n", "id", "class", "voxels");
  for (const SemanticClass& c : table.classes)
    if (c.detect) text += fmt::format("{:<6} {:<20} {:>10}\n", c.id, c.name, voxels[c.id]);
  return text;
}

/// Where the poses that were found are written.
std::filesystem::path poses_file(const MapVerbFlags& flags) {
  const std::filesystem::path map = flags.file;
  return map.parent_path() / (map.stem().string() + "_poses.txt");
}

/// A map and what is told of it.
struct Mapped {
  SemanticMap map;
  ClassTable table;
  double threshold;
  std::string text, poses = {};  ///< poses that were found, as TUM has them; else empty
};

/// Where `score` finds the map.
std::string lattice_line(const TrialSheet& sheet) {
  const Eigen::Vector3d& origin = sheet.map_origin_m;
  return fmt::format("its lattice, for `score`: --voxel_m {} --origin_m {} {} {} --yaw_deg {}\n",
                     sheet.voxel_m, origin.x(), origin.y(), origin.z(), sheet.map_yaw_deg);
}

/// What both files say must agree: method.yaml is what decides.
void check_sheet(const TrialSheet& sheet, const Study& study, const std::string& folder) {
  if (sheet.voxel_m != study.voxel_m)
    throw Error(fmt::format(
        "{}: voxel_m is {} in trial.yaml and {} in method.yaml; write the same into both",
        shown(folder), sheet.voxel_m, study.voxel_m));
}

Mapped mapped_trial(const MapVerbFlags& flags, const FramesDone& shown_done) {
  const std::string& path = flags.source.folder;
  const TrialFolder folder = flags.source.trial({FolderFlags::kGroup, "Mapping"}, {"--threshold"});
  const Study study = load_study(std::filesystem::path(path) / "method.yaml");
  if (study.methods.front().command)
    throw Error(fmt::format("{}: is the trial of a command (method.yaml), which maps it itself",
                            shown(path)));
  check_sheet(folder.sheet(), study, path);
  ClassTable table{folder.sheet().classes};
  FolderMapping mapping{mapping_of(study, table), {}, study.methods.front().refinement};
  MappedCounts counts;
  SemanticMap map = map_trial(folder, flags.source.chosen_frames(folder.frame_count()), mapping,
                              counts, shown_done);
  return {std::move(map), std::move(table),
          flags.threshold.value_or(default_threshold(mapping.mapping.fusion.rule)),
          counts_text({folder.frame_count()}, counts) + lattice_line(folder.sheet())};
}

Mapped mapped_folder(const MapVerbFlags& flags, const FramesDone& shown_done) {
  const std::optional<Study> study = study_of(flags);
  const bool has_poses = flags.poses == kPosesOfFile;
  LabelledFolder folder = flags.source.labelled(has_poses);
  if (flags.source.detect.empty() && study)
    folder.detect_as(detected_table(*study, folder.table()).classes);
  const FolderMapping mapping = folder_mapping(study, flags, folder.table());
  MappedCounts counts;
  std::string poses, poses_text;
  if (!has_poses) {
    const FolderPoses found = found_poses(flags, study, folder);
    poses_text = fmt::format("{}: {}; positions believed to {:.2g} m and better\n", flags.poses,
                             found.tracking.text(), found.sigma_m);
    poses = trajectory_text(found.trajectory);
  }
  SemanticMap map = map_folder(folder, flags.source.chosen_frames(folder.frame_count()), mapping,
                               counts, shown_done);
  return {std::move(map), folder.table(),
          flags.threshold.value_or(default_threshold(mapping.mapping.fusion.rule)),
          poses_text + counts_text(folder.counts(), counts), std::move(poses)};
}

void map_recording(const MapVerbFlags& flags) {
  std::vector<InputFile> inputs = flags.source.inputs();
  inputs.push_back({"--study", flags.study});
  const bool finds_poses = flags.poses != kPosesOfFile;
  check_outputs({{"-o", flags.file, ".ot"},
                 {"--color", flags.color_file, ".ot"},
                 {"--ply", flags.ply_file, ".ply"},
                 {"--poses", finds_poses ? poses_file(flags) : std::filesystem::path(), ""}},
                inputs);
  Progress progress("map", "frames", flags.quiet);
  const auto shown_done = [&](int done, int all) { progress.show(done, all); };
  const auto [map, table, threshold, text, poses] = is_trial_folder(flags.source.folder)
                                                        ? mapped_trial(flags, shown_done)
                                                        : mapped_folder(flags, shown_done);
  if (map.voxels().empty() && !flags.quiet)
    std::cerr << "mapscore: note: the map has no voxel; do the classes occur in the labels, and do "
                 "poses, depth and --origin_m fit?\n";
  const std::string found_file = poses.empty() ? "" : poses_file(flags).string();
  const auto together = lock_outputs({flags.file, flags.color_file, flags.ply_file, found_file});
  if (!poses.empty()) write_whole_file(found_file, poses);
  map.save(flags.file);
  if (!flags.color_file.empty()) map.export_color(flags.color_file, table, threshold);
  if (!flags.ply_file.empty()) write_voxel_ply(flags.ply_file, map, table, threshold);
  std::cout << text << class_lines(map, table, threshold) << shown(flags.file) << '\n';
  for (const std::string& file : {flags.color_file, flags.ply_file, found_file})
    if (!file.empty()) std::cout << shown(file) << '\n';
}

}  // namespace

void add_map(CLI::App& program) {
  const auto [verb, flags] = add_verb<MapVerbFlags>(
      program, "map", "Map a recording of any origin, truth or not", map_recording);
  verb->add_option("-o,--output", flags->file, "Map to write (.ot)")->required();
  verb->add_option("--color", flags->color_file,
                   "Also a ColorOcTree (.ot) in the class colours, for octovis and ROS");
  verb->add_option("--ply", flags->ply_file,
                   "Also the voxels' centres with colour, class and probability (.ply)");
  add_mapping_flags(*verb, *flags);
  verb->add_flag("-q,--quiet", flags->quiet, "No progress on standard error");
  verb->footer(
      "Prints frames, detections and voxels by class. docs/foreign_recordings.md has the files. "
      "With\n"
      "--poses of a source the poses that were found stand beside the map, in NAME_poses.txt.\n"
      "Examples:\n"
      "  mapscore map /data/apartment -o map.ot\n"
      "  mapscore map rgbd_dataset_freiburg3_long_office --intrinsics 535.4,539.2,320.1,247.6 "
      "--classes coco.yaml -o desk.ot --color desk_colour.ot\n"
      "  mapscore map /data/robot --intrinsics cameras.yaml --classes ade.yaml --depth_scale 1000 "
      "--study configs/demo.yaml --method direct --voxel_m 0.02 -o map.ot\n"
      "  mapscore map /data/robot --calibration calibration.yaml -o map.ot     of `calibrate`");
}

}  // namespace mapscore::eval
