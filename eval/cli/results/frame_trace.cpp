// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/results/frame_trace.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/trial_maps.hpp"
#include "eval/lab/commands/command_words.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/contact_sheet.hpp"
#include "eval/results/study_store.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>

namespace mapscore::eval {
namespace {

constexpr std::size_t kDrawnFrames = 4;
constexpr std::size_t kMemory_bytes = std::size_t{1} << 30;

/// What a store says of its study, and the recording that it was swept on.
struct SweptStudy {
  StudyRecord record;
  Recording recording;

  [[nodiscard]] Bench bench() const {
    return {recording, record.table, reads_colour(record.study), kMemory_bytes};
  }
};

/// `cell`: of the whole study, whose scene is wanted. Its doses become those of the scene's study.
SweptStudy swept_study(const std::filesystem::path& results, Cell& cell) {
  const std::filesystem::path file = store_file(results);
  const StudyRecord all = read_study(ResultStore::open_existing(file), file.parent_path());
  auto [record, recording] = scene_of(all, file.parent_path(), scene_of(all.study, cell));
  cell.doses = doses_of_scene(all.study, cell.doses);
  return {std::move(record), std::move(recording)};
}

/// Of a study without scenes.
SweptStudy swept_study(const std::filesystem::path& results) {
  const std::filesystem::path file = store_file(results);
  StudyRecord record = read_study(ResultStore::open_existing(file), file.parent_path());
  if (!record.scenes.empty())
    throw Error(
        "--frames: frames of a study of several scenes are not kept; leave the flag out, or check "
        "each scene by itself");
  Recording recording = recording_of(record, file.parent_path());
  return {std::move(record), std::move(recording)};
}

/// `seed`: of the draws, not of which cells there are.
std::vector<TrialYields> first_seed_yields(const SweptStudy& swept, std::uint64_t seed,
                                           const std::function<bool(const TrialSpec&)>& is_asked) {
  std::vector<TrialSpec> specs;
  for (const TrialSpec& spec : trials(swept.record.study))
    if (spec.seed_index == 0 && is_asked(spec) && !is_command(swept.record.study, spec.method))
      specs.push_back(spec);
  Study drawn = swept.record.study;
  drawn.seed = seed;
  Bench bench = swept.bench();
  return yields_of(drawn, specs, bench);
}

std::vector<std::string> classes_of(const JudgedFigure& figure, const ClassTable& table) {
  return figure.group == kPooled || figure.group == kMacro ? detected_names(table)
                                                           : std::vector{figure.group};
}

void keep_classes(const std::vector<std::string>& classes, const ClassTable& table,
                  JudgedMap& map) {
  const auto is_other = [&](const auto& voxel) {
    return std::ranges::count(classes, table.classes.at(voxel.class_id).name) == 0;
  };
  std::erase_if(map.voxels, is_other);
  std::erase_if(map.truth, is_other);
}

}  // namespace

std::vector<TrialYields> yields_of_store(const std::filesystem::path& results) {
  const SweptStudy swept = swept_study(results);
  return first_seed_yields(swept, swept.record.study.seed, [](const TrialSpec&) { return true; });
}

std::optional<FrameTrace> trace_frames(const std::filesystem::path& results, const Baseline& before,
                                       const JudgedFigure& worst) {
  const auto is_worst = [&](const auto& of) {
    return of.method == worst.method && of.cell.doses == worst.cell.doses;
  };
  const auto then = std::ranges::find_if(before.yields, is_worst);
  if (then == before.yields.end()) return std::nullopt;
  const SweptStudy swept = swept_study(results);
  const std::vector<TrialYields> now = first_seed_yields(swept, before.study.seed, is_worst);
  if (now.front().frames.size() != then->frames.size())
    throw Error("the recording has other frames than the baseline's");
  return FrameTrace{worst.method, worst.cell, worst.group,
                    frame_losses(*then, now.front(), classes_of(worst, swept.record.table))};
}

void draw_fallen(const std::filesystem::path& results, const JudgedFigure& worst,
                 const std::optional<FrameTrace>& trace, const std::filesystem::path& folder) {
  Cell cell = worst.cell;
  const SweptStudy swept = swept_study(results, cell);
  const Study& study = swept.record.study;
  const ClassTable& table = swept.record.table;
  const FolderLock lock(folder);
  std::filesystem::create_directories(folder);
  const PictureChoice choice{cell.doses, worst.method, 0, kMemory_bytes, {}};
  Pictures pictures = draw_pictures(study, table, swept.recording, choice, folder, [&] {
    Bench bench = swept.bench();
    std::vector<JudgedMap> maps = map_trials(swept.record.study, bench, choice);
    for (JudgedMap& map : maps) {
      map.title += ", " + shown(worst.group);
      keep_classes(classes_of(worst, swept.record.table), swept.record.table, map);
    }
    return maps;
  });
  std::vector<int> frames;
  for (std::size_t n = 0; trace && n < std::min(trace->losses.size(), kDrawnFrames); ++n)
    frames.push_back(trace->losses[n].frame);
  if (!frames.empty())
    pictures.files.push_back(
        write_picture(folder / "frames.png",
                      contact_sheet(resolve(study, cell), table, swept.recording, frames)));
  for (const auto& file : pictures.files) std::cerr << "check: " << shown(file) << '\n';
  if (!pictures.skipped.empty())
    std::cerr << "check: no pictures of the map: " << shown(pictures.skipped) << '\n';
}

}  // namespace mapscore::eval
