// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/render/baked_frames.hpp"
#include "eval/render/study_recording.hpp"

#include <iostream>

namespace mapscore::eval {
namespace {

struct RecordFlags {
  std::string source, folder, trajectory, motion;
  std::vector<std::string> overrides;
  bool bake = false;
  WorkFlags work;
};

void record(const RecordFlags& flags) {
  const bool is_scene = std::filesystem::path(flags.source).extension() == ".xml";
  if (is_scene && flags.trajectory.empty())
    throw Error(flags.source +
                ": a scene by itself says no way to drive; add --trajectory FILE, or record a "
                "study");
  Study study = is_scene ? study_of_scene(flags.source, flags.overrides)
                         : study_of_only_scene(load_study(flags.source, flags.overrides));
  if (study.scene && study.recording)
    throw Error("recording: `record` renders the scene anew and would not read it; leave it out");
  if (is_scene && study.detect)
    throw Error(
        "detect: a recording holds all classes; name those that are detected in a study, with "
        "`map --detect`, or in a class file (--set classes=FILE)");
  if (!flags.motion.empty()) study.motion = std::filesystem::absolute(flags.motion).string();
  if (flags.bake && has_verdict_faults(study))
    std::cerr << "record: note: wrong classes and scores are not baked: images of instance ids "
                 "cannot say them\n";
  ShownRecording display(flags.work.quiet);
  record_study(study, flags.folder, flags.work.jobs, display.progress(), flags.trajectory,
               flags.bake);
}

}  // namespace

void add_record(CLI::App& program) {
  const auto [verb, flags] =
      add_verb<RecordFlags>(program, "record", "Drive, render, write a recording", record);
  verb->add_option("SOURCE", flags->source, "Study file, or a scene (MJCF) with --trajectory")
      ->required();
  verb->add_option("-o,--output", flags->folder, "Folder of the recording; must not exist")
      ->required();
  verb->add_option(
      "--trajectory", flags->trajectory,
      "TUM lines (stamp tx ty tz qx qy qz qw) of the colour camera's optical frame in the "
      "world; replaces the study's drive");
  verb->add_option("--motion", flags->motion,
                   "Motion file (CSV: stamp_s and joints of the scene); replaces the study's");
  verb->add_flag("--bake", flags->bake,
                 "Write the study's faults of depth and labels (seed index 0) into depth/ and "
                 "label/, for other systems; truth stays exact");
  verb->add_option(
          "--set", flags->overrides,
          "Override a key of the study; a relative path counts from the folder of SOURCE; may "
          "be repeated")
      ->allow_extra_args(false);
  flags->work.add_to(*verb);
  verb->footer(
      "Examples:\n"
      "  mapscore record configs/demo.yaml -o /data/apartment\n"
      "  mapscore record configs/demo.yaml -o /data/shaded --set cameras.shadows=true\n"
      "  mapscore record configs/demo.yaml -o /data/driven --set trajectory.drive=wheels\n"
      "  mapscore record configs/demo.yaml -o /data/noisy --bake --set faults.depth.preset=astra\n"
      "  mapscore record scenes/apartment.xml --trajectory poses.txt -o /data/handheld\n"
      "  mapscore record scenes/moving_person.xml --motion scenes/moving_person.motion.csv "
      "--trajectory poses.txt -o /data/person");
}

}  // namespace mapscore::eval
