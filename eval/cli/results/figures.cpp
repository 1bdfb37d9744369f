// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/figures.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/figure_flags.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/trial_maps.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/bench.hpp"
#include "eval/report/figures/believed_figures.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/contact_sheet.hpp"
#include "eval/report/pictures/pictures.hpp"
#include "eval/report/selection.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct FiguresFlags {
  std::string results, folder;
  std::vector<std::string> trial;
  PictureChoice choice;  ///< but for what trial and view say
  bool no_pictures = false, interim = false;
  FigureFlags style;
  ViewFlag view;
};

PictureChoice choice_of(const FiguresFlags& flags, const Study& study) {
  PictureChoice choice = flags.choice;
  for (const std::string& dose : flags.trial) {
    const std::size_t equals = dose.find('=');
    if (equals == std::string::npos)
      throw Error("--trial " + dose +
                  ": must be path=value, e.g. faults.misregistration.magnitude_m=0.02");
    std::string path = dose.substr(0, equals), value = dose.substr(equals + 1);
    if (const auto axis = swept_axis(study, path)) {
      path = study.sweep[*axis].path;
      value = canonical_value(study, path, value);
    }
    choice.doses.emplace_back(std::move(path), std::move(value));  // refused where not swept
  }
  choice.view = flags.view.view();
  return choice;
}

void print(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) std::cout << shown(file) << std::endl;
}

/// Names the files, and what was left out of them for which reason.
void print_all(const Pictures& pictures, std::string_view what) {
  print(pictures.files);
  if (!pictures.skipped.empty())
    std::cerr << fmt::format("mapscore: no {}: {}\n", what, shown(pictures.skipped));
}

/// `path`: of the recording, from the folder of the store.
void draw_scene(const StudyRecord& all, const std::string& scene, const std::string& path,
                const fs::path& store, const PictureChoice& choice, const FigureStyle& style,
                const fs::path& folder) {
  const fs::path place = (store / path).lexically_normal();
  if (!fs::exists(place)) {
    std::cerr << "mapscore: no pictures: the recording " << shown(place)
              << " is not there; `mapscore sweep` renders it\n";
    return;
  }
  const auto [record, recording] = scene_of(all, store, scene);
  const Study& study = record.study;
  check_inputs(all, study);
  const ClassTable& table = record.table;
  const Recording& drawn = recording;
  fs::create_directories(folder);
  print({write_picture(folder / "contact_sheet.png", contact_sheet(study, table, drawn))});
  print_all(draw_believed(study, drawn, choice, folder, style), "trajectory_on_grid");
  const Pictures pictures = draw_pictures(study, table, drawn, choice, folder, [&] {
    Bench bench(drawn, table, reads_colour(study), choice.memory_bytes);
    return map_trials(study, bench, choice);
  });
  print_all(pictures, "pictures of the map");
}

/// Pictures of the recording, or of each scene in a folder of its own.
void draw_from_recording(const FiguresFlags& flags, PictureChoice choice, const FigureStyle& style,
                         const fs::path& folder) {
  const fs::path file = store_file(flags.results);
  const StudyRecord record = read_study(ResultStore::open_existing(file), file.parent_path());
  if (record.scenes.empty())
    return draw_scene(record, "", record.recording, file.parent_path(), choice, style, folder);
  const std::string asked = scene_of(record.study, {0, choice.doses});
  choice.doses = doses_of_scene(record.study, choice.doses);
  for (const SceneRecord& scene : record.scenes)
    if (asked.empty() || asked == scene.name)
      draw_scene(record, scene.name, scene.recording, file.parent_path(), choice, style,
                 folder / scene.name);
}

void figures(const FiguresFlags& flags) {
  const FigureStyle style = flags.style.style();
  const fs::path file = store_file(flags.results);
  const Study study = read_study(ResultStore::open_existing(file), file.parent_path()).study;
  const PictureChoice choice = choice_of(flags, study);
  check_choice(study, choice);
  const StudySummary summary = summarise_store(
      flags.results, {.interim = flags.interim, .failed_commands = true, .pool_scenes = true});
  const fs::path folder =
      !flags.folder.empty()
          ? fs::path(flags.folder)
          : file.parent_path() / (summary.is_finished ? "figures" : "interim_figures");
  const FolderLock lock(folder);
  print({write_table(summary, folder)});
  print(draw_figures(summary, folder, style));
  if (!flags.no_pictures) draw_from_recording(flags, choice, style, folder);
}

}  // namespace

void add_figures(CLI::App& program) {
  const auto [verb, flags] = add_verb<FiguresFlags>(
      program, "figures", "Draw figures and pictures of a swept study", figures);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("-o,--output", flags->folder,
                   "Folder of the pictures [RESULTS/figures, or RESULTS/interim_figures]");
  verb->add_option("--trial", flags->trial,
                   "Dose whose maps are drawn, path=value of a swept path or of its end; may be "
                   "repeated [the "
                   "middle of each]")
      ->allow_extra_args(false);
  verb->add_option("--method", flags->choice.method, "Draw the map of this method alone [all]");
  verb->add_option("--seed", flags->choice.seed_index, "Index of the seed whose maps are drawn [0]")
      ->check(CLI::NonNegativeNumber);
  flags->view.add_to(*verb);
  add_memory_flag(*verb, flags->choice.memory_bytes);
  add_interim_flag(*verb, flags->interim);
  verb->add_flag("--no_pictures", flags->no_pictures, "Figures and tables alone");
  flags->style.add_to(*verb);
  verb->footer(
      "Writes table.txt, figures (PNG, PDF, SVG, and the gnuplot script and numbers "
      "they are made of),\n"
      "a contact sheet of the recording, the robot's way as its localisation believes it, and "
      "pictures of maps and of their errors. Prints where "
      "each is.\n"
      "All numbers of all trials: `mapscore table RESULTS --tidy`.\n"
      "Examples:\n"
      "  mapscore figures results/demo\n"
      "  mapscore figures results/demo -o paper --trial magnitude_m=0.04\n"
      "  mapscore figures results/demo --view 4 1 2.2 5.5 3 0.8\n"
      "  mapscore figures results/person --no_pictures\n"
      "  mapscore figures results/demo -o paper --width_mm 85 --grey --no_caption  # one column\n"
      "  mapscore figures results/demo -o slides --width_mm 240 --font \"DejaVu Serif\"");
}

}  // namespace mapscore::eval
