// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/score_flags.hpp"
#include "eval/foreign/label_classes.hpp"
#include "eval/foreign/network_labels.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/label_errors.hpp"
#include "eval/score/label_images.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <utility>

namespace mapscore::eval {
namespace {

/// What a class file says of labels; others but 0 have no meaning.
LabelLegend legend_of_classes(const std::filesystem::path& file, const ClassTable& table) {
  const LabelClasses classes = read_label_classes(file, ClassMasks::components);
  return [listed = classes.class_of_value(ClassMasks::components),
          meaning = classes_of_values(classes, file, ClassMasks::components, table)](
             std::uint16_t id) -> std::optional<ClassId> {
    if (id != 0 && listed[id] == kBackground) return std::nullopt;
    return meaning[id];
  };
}

LabelLegend legend_of(const ScoreFlags& flags, const ClassTable& table) {
  const LabelLegend own = class_id_legend(table);
  const std::string& file = flags.map.legend;
  if (file.empty()) return own;
  if (load_yaml(file).has("classes")) return legend_of_classes(file, table);
  return [own, legend = read_legend(file, table)](std::uint16_t id) -> std::optional<ClassId> {
    const auto found = legend.ids.find(id);
    return found == legend.ids.end() ? own(id) : std::optional(found->second);
  };
}

/// A folder of label images is scored pixel by pixel: flags of voxels would do nothing.
void check_label_flags(const ScoreFlags& flags) {
  const LatticeFlags none;
  const LatticeFlags& lattice = flags.lattice;
  const std::pair<bool, const char*> idle[] = {
      {!flags.errors_ply.empty(), "--errors_ply"},
      {flags.view.view().has_value(), "--view"},
      {flags.threshold.has_value(), "--threshold"},
      {!flags.map.transform.empty(), "--transform"},
      {flags.align, "--align"},
      {flags.map.scale != 1.0, "--scale"},
      {flags.map.geometry, "--geometry"},
      {flags.map.resample, "--resample"},
      {flags.map.skip_nan, "--skip_nan"},
      {flags.map.trust_frame, "--trust_frame"},
      {lattice.voxel_m != none.voxel_m, "--voxel_m"},
      {lattice.origin_m != none.origin_m, "--origin_m"},
      {lattice.yaw_deg != none.yaw_deg, "--yaw_deg"},
      {lattice.epsilon_m != none.epsilon_m, "--epsilon_m"},
      {lattice.min_samples != none.min_samples, "--min_samples"}};
  for (const auto& [given, flag] : idle)
    if (given)
      throw Error(
          fmt::format("{}: {} is a folder of label images, which have no voxels; leave it out",
                      flag, flags.map.file));
}

/// The frames with most wrong pixels, in their order; frames without any are left out, unless no
/// frame has one.
std::vector<int> worst(const std::vector<int>& frames, const std::vector<std::int64_t>& wrong_px) {
  constexpr std::size_t kMost = 4;
  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t n) { return wrong_px[n]; });
  order.resize(std::min(kMost, order.size()));
  while (order.size() > 1 && wrong_px[order.back()] == 0) order.pop_back();
  std::vector<int> found;
  for (const std::size_t n : order) found.push_back(frames[n]);
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::vector<Table> score_label_images(const ScoreFlags& flags, TruthSource& source) {
  check_label_flags(flags);
  if (!source.recording())
    throw Error(flags.map.file + ": a folder of label images needs a recording as --truth");
  std::error_code none;
  // The recording's own label images hold numbers of instances, which would pass for classes.
  if (std::filesystem::equivalent(flags.map.file, source.recording()->folder() / "label", none))
    throw Error(flags.map.file +
                ": holds ids of instances, the truth; label images to score hold ids of classes");
  const LabelFolder all{*source.recording(), flags.map.file, source.table(),
                        legend_of(flags, source.table())};
  const LabelFolder labels = flags.detect.empty() ? all : with_undetected_as_background(all);
  const std::vector<int> frames = source.frames();
  const LabelFolderScore score = score_label_folder(labels, frames, flags.work.jobs);
  if (!flags.picture.empty()) {
    const auto together = lock_outputs({flags.picture});
    write_picture(flags.picture, label_errors(labels, worst(frames, score.wrong_px)));
  }
  if (flags.tidy) return {tidy_label_table(score, source.table())};
  std::vector<Table> tables = label_tables(score, source.table());
  std::vector<std::string>& caption = tables.front().caption;
  caption.insert(caption.begin(), fmt::format("{} against the label images of {}, {} frames",
                                              flags.map.file, flags.truth, frames.size()));
  if (!flags.detect.empty())
    caption.push_back("classes that --detect does not name are background, on both sides");
  if (!flags.details) tables.resize(1);
  return tables;
}

}  // namespace mapscore::eval
