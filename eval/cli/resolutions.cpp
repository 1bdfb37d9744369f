// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "core/mapping/map_resolution.hpp"
#include "eval/cli/shared/map_score.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/pictures/map_pictures.hpp"
#include "eval/report/pictures/view.hpp"
#include "eval/report/tables/tidy_csv.hpp"

#include <fmt/format.h>

#include <bit>
#include <iostream>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

struct ResolutionFlags {
  MapFlags map;
  std::string truth, rule = "blend", format = "text", color, picture;
  std::vector<int> times{1, 2, 4, 8};
  std::optional<double> threshold;
  std::vector<std::string> detect;
  LatticeFlags lattice;
  ViewFlag view;
  WorkFlags work;
};

/// How the voxels of a cube are put together; its numbers beyond the kind do not matter there, but
/// for the priors, which are equal.
FusionRule rule_of(const std::string& name, const ClassTable& table) {
  for (const DrawnFusion& kind : each_kind<DrawnFusion>())
    if (kind_of(kind) == name) return for_classes(kind, table).rule;
  throw Error("--fusion: no rule '" + name + "'");
}

/// The map with voxels of `times` its size, as a map to score.
InputMap read_coarse(const ResolutionFlags& flags, const SemanticMap& map, const FusionRule& rule,
                     int times, std::size_t class_count) {
  std::vector<MapVoxel> voxels;
  for (const CoarseVoxel& voxel : read_at(map, rule, times)) {
    const ClassProbability best = voxel.best();
    check_class(voxel.key, best.class_id, class_count);
    if (best.probability > 1.0)
      throw Error(fmt::format(
          "{}: was not made by --fusion {}, whose voxels cannot add up to a probability of {:.3g}; "
          "name the rule that the map was made by",
          flags.map.file, flags.rule, best.probability));
    voxels.push_back({voxel.key, best.class_id, best.probability, voxel.occupied});
  }
  InputMap coarse;
  coarse.snapshot = MapSnapshot(std::move(voxels));
  return coarse;
}

void check_times(const std::vector<int>& all) {
  for (const int times : all)
    if (times < 1 || times > 1024 || !std::has_single_bit(static_cast<unsigned>(times)))
      throw Error(fmt::format("--times: {} is not 1, 2, 4, 8, ... or 1024", times));
  if (std::set<int>(all.begin(), all.end()).size() < all.size())
    throw Error("--times: says a size twice; name each once");
}

std::filesystem::path numbered(const std::filesystem::path& file, int times) {
  return file.parent_path() /
         fmt::format("{}_x{}{}", file.stem().string(), times, file.extension().string());
}

struct Resolutions {
  Table table;
  std::vector<JudgedMap> maps;
  ClassTable classes;
};

void add_row(const MapScore& score, double edge_m, int times, Table& table) {
  const std::vector<Metric> metrics = tidy_metrics(score.counts, score.table, kPooled);
  const auto text = [&](const char* name) {
    const auto value = value_of(metrics, name);
    return value ? fmt::format("{:.3f}", *value) : std::string("-");
  };
  const ClassCounts pooled = pool_detected(score.counts, score.table);
  table.rows.push_back({std::to_string(times), fmt::format("{:.6g}", edge_m),
                        std::to_string(pooled.predicted), std::to_string(pooled.visible),
                        text("precision"), text("recall"), text("f1")});
}

/// Reads, scores and, for pictures, judges the map at each size against the truth at that size.
Resolutions score_sizes(const ResolutionFlags& flags, const SemanticMap& map) {
  Resolutions result;
  result.table.columns = {"times", "voxel_m", "voxels", "truth", "precision", "recall", "F1"};
  Progress progress("resolutions", "sizes", flags.work.quiet);
  for (const int times : flags.times) {
    LatticeFlags lattice = flags.lattice;
    lattice.voxel_m = map.edge_m() * times;
    TruthSource source(flags.truth, lattice, flags.work);
    if (!flags.detect.empty()) source.detect(flags.detect);
    const FusionRule rule = rule_of(flags.rule, source.table());
    const double threshold = flags.threshold.value_or(default_threshold(rule));
    const InputMap coarse = read_coarse(flags, map, rule, times, source.table().classes.size());
    const MapScore score = score_input(coarse, flags.map, threshold, source, flags.work.jobs);
    if (!score.note.empty() && !flags.work.quiet)
      std::cerr << "mapscore: note: " << score.note << '\n';
    add_row(score, lattice.voxel_m, times, result.table);
    const std::string title = fmt::format("{:.6g} cm: {} voxels, F1 {}", 100 * lattice.voxel_m,
                                          result.table.rows.back()[2], result.table.rows.back()[6]);
    result.maps.push_back(judged_map("", title, coarse.snapshot, threshold, score.truth->surface,
                                     score.truth->view.visible, score.table,
                                     lattice.map_frame().T_map_world()));
    result.classes = score.table;
    if (!flags.color.empty())
      export_color_at(map, rule, times, Paint::classes, score.table, threshold,
                      numbered(flags.color, times));
    progress.show(static_cast<int>(result.maps.size()), static_cast<int>(flags.times.size()));
  }
  return result;
}

void read_resolutions(const ResolutionFlags& flags) {
  check_times(flags.times);
  std::vector<OutputFile> outputs{{"--picture", flags.picture, ".png"}};
  for (const int times : flags.times)
    if (!flags.color.empty()) outputs.push_back({"--color", numbered(flags.color, times), ".ot"});
  check_outputs(outputs);
  if (flags.view.view() && flags.picture.empty())
    throw Error("--view: needs --picture, the file that it is drawn into");
  const SemanticMap map = SemanticMap::load(flags.map.file);
  const auto together = lock_outputs({flags.picture, flags.color});
  Resolutions sizes = score_sizes(flags, map);
  if (!flags.picture.empty()) {
    const TruthSource source(flags.truth, flags.lattice, flags.work);
    ScenePainter painter(source.shapes(), sizes.classes);
    const sim::View view = flags.view.view().value_or(overview(sizes.maps));
    write_picture(flags.picture, resolution_picture(sizes.maps, sizes.classes, painter, view));
  }
  sizes.table.caption = {
      fmt::format("{}, read as {} puts voxels together, against {} at the same size",
                  flags.map.file, flags.rule, flags.truth)};
  std::cout << formatted(sizes.table, flags.format);
}

}  // namespace

void add_resolutions(CLI::App& program) {
  const auto [verb, flags] = add_verb<ResolutionFlags>(
      program, "resolutions", "Read one semantic map at 1, 2, 4, 8 times its voxels and score each",
      read_resolutions);
  verb->add_option("MAP", flags->map.file, "Map of `map` or `run` (.ot, type SemanticOcTree)")
      ->required();
  verb->add_option("--truth", flags->truth, "Recording, or scene (MJCF)")->required();
  verb->add_option("--times", flags->times, "Voxels of so many times the map's edge [1,2,4,8]")
      ->delimiter(',')
      ->allow_extra_args(false);
  const std::vector<std::string> rules = kinds_of(DrawnFusion{});
  verb->add_option("--fusion", flags->rule,
                   fmt::format("Rule that the map was made by: {} [{}]", fmt::join(rules, ", "),
                               flags->rule))
      ->check(CLI::IsMember(rules));
  verb->add_option("--threshold", flags->threshold,
                   "Least probability of a predicted voxel [half of the rule's first full hit]")
      ->check(finite_within(0.0, 1.0));
  add_list(*verb, "--detect", flags->detect, "Classes that count, by commas, or all [the truth's]");
  verb->add_option("--picture", flags->picture, "PNG: the maps side by side in class colours");
  flags->view.add_to(*verb);
  verb->add_option("--color", flags->color,
                   "FILE.ot: also ColorOcTrees FILE_x1.ot, FILE_x2.ot, ... for octovis and ROS");
  add_format_flag(*verb, flags->format);
  flags->lattice.add_without_voxel_to(*verb);
  flags->work.add_to(*verb);
  verb->footer(
      "Occupancy of a coarse voxel is the largest of its voxels', its class what the fusion rule "
      "makes of theirs (docs/octree.md).\n"
      "Examples:\n"
      "  mapscore resolutions map.ot --truth /data/apartment\n"
      "  mapscore resolutions map.ot --truth scenes/home.xml --times 1,2,4,8,16 --picture "
      "sizes.png");
}

}  // namespace mapscore::eval
