// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/object_run.hpp"
#include "eval/objects/object_file.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/tables/table.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct ObjectFlags {
  std::string source, output, method, update = "quantile", against = "surface", format = "text";
  std::optional<std::string> start;
  std::vector<std::string> overrides;
  std::optional<double> face_share;
  ObjectRunOptions options;  ///< but for the rule of boxes
  int seed = 0, jobs = WorkFlags{}.jobs;
  bool quiet = false;
};

/// A study of nothing but a recording, in the scene's world, with every method by its name.
Study study_of_recording(const fs::path& folder, const std::vector<std::string>& overrides) {
  Study study;
  study.name = folder.filename().string();
  study.recording = fs::absolute(folder).string();
  for (const Segmentation& kind : each_kind<Segmentation>())
    study.methods.push_back({std::string(kind_of(kind)), kind});
  study.map_origin_m = {0, 0, 0};
  set_leaves(study, overrides);
  check(study);
  return study;
}

Study study_of(const ObjectFlags& flags) {
  Study study = fs::is_directory(flags.source)
                    ? study_of_recording(flags.source, flags.overrides)
                    : study_of_only_scene(load_study(flags.source, flags.overrides));
  study.sweep.clear();
  return study;
}

/// One method and repetition, at the study's own doses.
TrialSpec spec_of(const Study& study, const ObjectFlags& flags) {
  if (flags.seed >= study.seeds)
    throw Error(fmt::format("--seed {}: no such repetition; they are 0 to {}", flags.seed,
                            study.seeds - 1));
  const std::string method = flags.method.empty() ? study.methods.front().name : flags.method;
  require_one_of(method_names(study), method, fmt::format("--method {}: no such method", method));
  return {0, method, {}, flags.seed};
}

ObjectRunOptions options_of(const ObjectFlags& flags) {
  if (flags.face_share && flags.update != "quantile")
    throw Error("--face_share: belongs to --update quantile; leave it out");
  ObjectRunOptions options = flags.options;
  options.map.update.rule = flags.update == "hull"   ? BoxUpdate::hull
                            : flags.update == "mean" ? BoxUpdate::mean
                                                     : BoxUpdate::quantile;
  if (flags.face_share) options.map.update.share = *flags.face_share;
  return options;
}

void drive_through(const Recording& recording, bool quiet, ObjectRun& run) {
  Progress progress("objects", "frames", quiet);
  const Channels channels{.depth_label = recording.info().has_truth};
  for (int frame = 0; frame < recording.frame_count(); ++frame) {
    run.advance(recording.read(frame, run.depth_of(frame), channels));
    progress.show(frame + 1, recording.frame_count());
  }
}

void write_files(const ObjectRun& run, const ClassTable& table, const fs::path& folder) {
  const ObjectFile file = run.file();
  const FolderLock lock(folder);
  fs::create_directories(folder);
  write_whole_file(folder / "objects.yaml", object_text(file, table));
  write_whole_file(folder / "objects.xml", object_mjcf(file, table));
  write_whole_file(folder / "objects.ply", object_ply(file.objects, table));
}

void map_objects(const ObjectFlags& flags) {
  const Study study = study_of(flags);
  const TrialSpec spec = spec_of(study, flags);
  const ObjectRunOptions options = options_of(flags);
  for (const char* name : {"objects.yaml", "objects.xml", "objects.ply"})
    if (fs::is_directory(fs::path(flags.output) / name))
      throw Error((fs::path(flags.output) / name).string() + ": is a folder; remove it");
  ShownRecording display(flags.quiet);
  const Recording recording = recording_of(study, flags.output, flags.jobs, display.progress());
  const ClassTable table = detected_table(study, recording.info().table);
  const Task task = task_of(study, spec, Labels::detected, recording.content_hash());
  PoseSources poses(recording);
  ObjectRun run(task, recording, table, poses, options);
  if (!run.sights().calibration_note().empty())
    std::cerr << fmt::format("objects: {}\n", run.sights().calibration_note());
  if (flags.start) run.start_from(read_objects(*flags.start, table));
  drive_through(recording, flags.quiet, run);
  write_files(run, table, flags.output);
  if (!recording.info().has_truth) return;
  const std::vector<ObjectCounts> counts =
      score_objects(run.map().objects(), run.truth(flags.against == "seen"), table.classes.size());
  std::cout << formatted(object_table(counts, table), flags.format);
}

/// How the points of a detection become a box, and the boxes of views an object.
void add_box_flags(CLI::App& verb, ObjectFlags& flags) {
  verb.add_option("--update", flags.update, "How boxes of views are merged: hull, mean or quantile")
      ->check(CLI::IsMember({"hull", "mean", "quantile"}))
      ->capture_default_str();
  verb.add_option("--face_share", flags.face_share,
                  fmt::format("Of quantile: share of the views that see each face no farther out "
                              "[{}]",
                              BoxMerge{}.share))
      ->check(CLI::Range(0.01, 1.0));
  verb.add_option("--piece_m", flags.options.piece_m,
                  "Cells in which the points of a detection hang together; the largest piece "
                  "becomes the box")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  verb.add_option("--max_age", flags.options.map.max_age,
                  "Frames in a row after which an object is removed that should have been seen "
                  "and was not")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb.add_option("--min_points", flags.options.min_points,
                  "Points of a detection that becomes a box")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

}  // namespace

void add_objects(CLI::App& program) {
  const auto [verb, flags] = add_verb<ObjectFlags>(
      program, "objects", "Map and score objects: class, pose, size, model", map_objects);
  verb->add_option("SOURCE", flags->source,
                   "Recording's folder, or a study (its sweep is left out)")
      ->required()
      ->check(CLI::ExistingPath);
  verb->add_option("-o,--output", flags->output,
                   "Folder for objects.yaml, objects.xml (MJCF) and objects.ply")
      ->required();
  verb->add_option("--method", flags->method,
                   fmt::format("Of the study, default its first; of a recording {}",
                               fmt::join(kinds_of(Segmentation{}), ", ")));
  verb->add_option("--seed", flags->seed, "Repetition of the study, from 0")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  verb->add_option("--start", flags->start, "Object map (YAML) to start from");
  add_box_flags(*verb, *flags);
  verb->add_option("--against", flags->against,
                   "Boxes of the truth: of the whole surface, or of what the frames saw of it")
      ->check(CLI::IsMember({"surface", "seen"}))
      ->capture_default_str();
  verb->add_option("--format", flags->format, "Of the table: text, csv or json")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  verb->add_option("--set", flags->overrides, "A key of the study, path=value; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("-j,--jobs", flags->jobs, "Threads that render a study's recording [all cores]")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("-q,--quiet", flags->quiet, "No progress on standard error");
  verb->footer(
      "Prints found, missed and false objects by class, and the errors of centres and sizes of "
      "those found\n"
      "(docs/objects.md).\n"
      "Examples:\n"
      "  mapscore objects results/demo/recordings/apartment-* -o objects\n"
      "  mapscore objects configs/demo.yaml -o results/demo --method erosion "
      "--set faults.labels.preset=typical\n"
      "  mapscore objects /data/tuesday -o tuesday --start monday/objects.yaml --format csv\n"
      "  mapscore info objects/objects.xml");
}

}  // namespace mapscore::eval
