// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/results/frame_trace.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/trial_maps.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/contact_sheet.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kDrawnFrames = 4;
constexpr std::size_t kMemory_bytes = std::size_t{1} << 30;

StudyRecord record_of(const std::filesystem::path& results) {
  const std::filesystem::path file = store_file(results);
  return read_study(ResultStore::open_existing(file), file.parent_path());
}

/// The recording that results were swept on.
Recording recording_of_store(const std::filesystem::path& results, const StudyRecord& record) {
  const std::filesystem::path folder =
      (store_file(results).parent_path() / record.recording).lexically_normal();
  Recording recording = Recording::open(folder);
  if (recording.content_hash() != record.recording_hash)
    throw Error(folder.string() + ": is another recording than that of the trials; sweep again");
  return recording;
}

std::vector<TrialYields> walked(const StudyRecord& record, const Recording& recording,
                                const std::function<bool(const TrialSpec&)>& is_asked) {
  std::vector<TrialSpec> specs;
  for (const TrialSpec& spec : trials(record.study))
    if (spec.seed_index == 0 && is_asked(spec)) specs.push_back(spec);
  Bench bench(recording, record.table, reads_colour(record.study), kMemory_bytes);
  return yields_of(record.study, specs, bench);
}

}  // namespace

std::vector<TrialYields> yields_of_store(const std::filesystem::path& results) {
  const StudyRecord record = record_of(results);
  return walked(record, recording_of_store(results, record), [](const TrialSpec&) { return true; });
}

TracedTrial::TracedTrial(const std::filesystem::path& results, const JudgedFigure& worst)
    : record_(record_of(results)),
      recording_(recording_of_store(results, record_)),
      worst_(worst),
      classes_(worst.group == kPooled || worst.group == kMacro ? detected_names(record_.table)
                                                               : std::vector{worst.group}) {}

std::optional<FrameTrace> TracedTrial::trace(const Baseline& before) const {
  const auto is_worst = [&](const auto& of) {
    return of.method == worst_.method && of.cell.doses == worst_.cell.doses;
  };
  const auto then = std::ranges::find_if(before.yields, is_worst);
  if (then == before.yields.end()) return std::nullopt;
  StudyRecord record = record_;
  record.study.seed = before.study.seed;  // so that all draws are the same
  const std::vector<TrialYields> now = walked(record, recording_, is_worst);
  if (now.front().frames.size() != then->frames.size())
    throw Error("the recording has other frames than the baseline's");
  return FrameTrace{worst_.method, worst_.cell, worst_.group,
                    frame_losses(*then, now.front(), classes_)};
}

void TracedTrial::draw(const std::filesystem::path& folder,
                       const std::optional<FrameTrace>& trace) const {
  const FolderLock lock(folder);
  std::filesystem::create_directories(folder);
  const PictureChoice choice{worst_.cell.doses, worst_.method, 0, kMemory_bytes, {}};
  Pictures pictures = draw_pictures(record_.study, record_.table, recording_, choice, folder, [&] {
    Bench bench(recording_, record_.table, reads_colour(record_.study), kMemory_bytes);
    std::vector<JudgedMap> maps = map_trials(record_.study, bench, choice);
    for (JudgedMap& map : maps) keep_classes(map);
    return maps;
  });
  std::vector<int> frames;
  if (trace)
    for (const FrameLoss& loss : trace->losses)
      if (frames.size() < kDrawnFrames) frames.push_back(loss.frame);
  if (!frames.empty())
    pictures.files.push_back(write_picture(
        folder / "frames.png",
        contact_sheet(resolve(record_.study, worst_.cell), record_.table, recording_, frames)));
  for (const auto& file : pictures.files) std::cerr << "check: " << shown(file) << '\n';
  if (!pictures.skipped.empty())
    std::cerr << "check: no pictures of the map: " << shown(pictures.skipped) << '\n';
}

void TracedTrial::keep_classes(JudgedMap& map) const {
  const auto is_other = [&](const auto& voxel) {
    return std::ranges::count(classes_, record_.table.classes.at(voxel.class_id).name) == 0;
  };
  map.title += ", " + shown(worst_.group);
  std::erase_if(map.voxels, is_other);
  std::erase_if(map.truth, is_other);
}

}  // namespace mapscore::eval
