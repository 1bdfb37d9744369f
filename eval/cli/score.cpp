// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/score_flags.hpp"
#include "eval/cli/shared/frame_check.hpp"
#include "eval/cli/shared/map_score.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "eval/report/pictures/map_pictures.hpp"
#include "eval/report/pictures/view.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "eval/report/tables/tidy_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

namespace mapscore::eval {
namespace {

void print(const ScoreFlags& flags, const std::vector<Table>& tables) {
  if (flags.tidy) {  // for other tools: never as text
    std::cout << (flags.format == "json" ? to_json(tables.front()) : to_csv(tables.front()));
    return;
  }
  if (flags.format == "json" && tables.size() > 1) {
    std::cout << to_json(tables);
    return;
  }
  for (std::size_t n = 0; n < tables.size(); ++n)
    std::cout << (n ? "\n" : "") << formatted(tables[n], flags.format);
}

std::vector<std::string> caption_of(const ScoreFlags& flags, const InputMap& map,
                                    const MapScore& score, const TruthSource& source) {
  std::string seen = "all of the scene's surface counts as visible; no samples";
  if (source.recording())
    seen = fmt::format("visible with {} samples in {} of {} frames", flags.lattice.min_samples,
                       source.frames().size(), source.recording()->frame_count());
  std::string detected;
  for (const SemanticClass& c : score.table.classes)
    if (c.detect) detected += (detected.empty() ? "" : ", ") + c.name;
  std::vector<std::string> caption{
      fmt::format("{} against {}, {}", flags.map.file, flags.truth, seen),
      fmt::format("voxels of {} m, origin {} {} {} m, yaw {} deg, epsilon {} m; threshold {}",
                  flags.lattice.voxel_m, flags.lattice.origin_m[0], flags.lattice.origin_m[1],
                  flags.lattice.origin_m[2], flags.lattice.yaw_deg, flags.lattice.epsilon_m,
                  score.threshold),
      fmt::format("pooled and macro over: {}", detected)};
  if (!map.placing.empty()) caption.push_back("the map: " + map.placing);
  if (map.geometry) caption.emplace_back("geometry alone: occupied voxels against all surfaces");
  return caption;
}

/// The labels without meaning in one line, the commonest first.
std::string text_of(const std::vector<Leftover>& leftovers) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t n = 0; n < std::min(kMost, leftovers.size()); ++n)
    text += fmt::format("{}{} ({})", n ? ", " : "", leftovers[n].label, leftovers[n].count);
  if (leftovers.size() > kMost) text += fmt::format(" and {} more", leftovers.size() - kMost);
  return text;
}

/// What the user may want to know, of figures that are right as they are.
void note(const ScoreFlags& flags, const std::string& text) {
  std::cerr << "mapscore: note: " << (flags.maps.size() > 1 ? flags.map.file + ": " : "") << text
            << '\n';
}

/// The verdicts that were asked for, in the scene and as points.
void write_errors(const ScoreFlags& flags, const InputMap& map, const MapScore& score,
                  const TruthSource& source) {
  if (flags.picture.empty() && flags.errors_ply.empty()) return;
  const auto together = lock_outputs({flags.picture, flags.errors_ply});
  const std::string name = std::filesystem::path(flags.map.file).filename().string();
  const JudgedMap judged =
      judged_map(name, name, map.snapshot, score.threshold, score.truth->surface,
                 score.truth->view.visible, score.table, flags.lattice.map_frame().T_map_world());
  if (!flags.errors_ply.empty()) write_error_ply(flags.errors_ply, judged);
  if (flags.picture.empty()) return;
  ScenePainter painter(source.shapes(), source.table());
  std::vector<Pose> T_world_depth;
  if (source.recording()) T_world_depth = depth_camera_poses(*source.recording());
  draw_error_picture(flags.picture, judged, painter, flags.view.view(), T_world_depth);
}

void note_labels(const ScoreFlags& flags, const Labelling& map) {
  if (!map.leftovers.empty())
    note(flags,
         "labels without a meaning: " + text_of(map.leftovers) + "; --legend can give them one");
  if (!map.unlisted.empty())
    note(flags,
         "labels that the legend does not list, which so mean what they mean in the truth's "
         "table: " +
             text_of(map.unlisted));
}

/// A map as it was scored.
struct ScoredMap {
  InputMap map;
  MapScore score;
  std::vector<std::string> alignment;  ///< in words, with --align
};

ScoredMap score_at(const ScoreFlags& flags, const LabelledMap& map, const Pose& T_map_file,
                   TruthSource& source) {
  ScoredMap scored{placed(map, flags.map, T_map_file, flags.lattice.voxel_m), {}, {}};
  const double threshold =
      flags.threshold.value_or(map.geometry ? 0.0 : default_threshold(BlendRule{}));
  scored.score = score_input(scored.map, flags.map, threshold, source, flags.work.jobs);
  return scored;
}

/// Where the map's elements lie that are occupied, in the map frame.
std::vector<Eigen::Vector3d> points_of(const MapFile& map, const Pose& T_map_file, double edge_m) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t n = 0; n < map.size(); ++n)
    if (map.is_occupied(n))
      points.emplace_back(T_map_file *
                          (map.points.empty()
                               ? centre_of(map.voxels[n], map.edge_m > 0 ? map.edge_m : edge_m)
                               : map.points[n]));
  return points;
}

std::optional<double> pooled_f1(const MapScore& score) {
  return value_of(tidy_metrics(score.counts, score.table, kPooled), "f1");
}

/// F1 of the map where it says it lies; none where that is beyond the lattice, as that of a map in
/// the coordinates of a country.
std::optional<double> f1_as_given(ScoreFlags flags, const LabelledMap& map, const Pose& T_map_file,
                                  TruthSource& source) try {
  flags.map.trust_frame = true;
  return pooled_f1(score_at(flags, map, T_map_file, source).score);
} catch (const Error&) {
  return std::nullopt;
}

/// Moves the map to where its geometry fits the truth's surfaces best, and says what that changed.
ScoredMap score_aligned(const ScoreFlags& flags, const LabelledMap& map, TruthSource& source) {
  const Pose T_map_file = flags.map.T_map_file();
  const std::vector<Eigen::Vector3d> points =
      points_of(map.file, T_map_file, flags.lattice.voxel_m);
  const Alignment found = source.aligner().align(points);
  if (!found.refusal.empty()) {
    const std::string unit = unit_trouble(points, source.surface(), flags.map.scale);
    throw Error(fmt::format("{}: --align: {}; {}", flags.map.file, found.refusal,
                            unit.empty() ? "give --transform, or leave --align out" : unit));
  }
  const Pose T_aligned = found.best.motion * T_map_file;
  ScoredMap after = score_at(flags, map, T_aligned, source);
  after.alignment = {
      fmt::format(
          "aligned by {}: F1 {} -> {}, {:.1f} -> {:.1f} % of its surfaces on the truth's, {:.1f} % "
          "at the next best place",
          motion_text(found.best.motion), cell_text(f1_as_given(flags, map, T_map_file, source)),
          cell_text(pooled_f1(after.score)), 100 * found.before.share, 100 * found.best.share,
          100 * found.next.share),
      fmt::format("the same: --transform '{}'", transform_text(T_aligned))};
  return after;
}

/// The tables of one map; `geometry`: whether the maps before it were without labels, if any were.
std::vector<Table> score_map(const ScoreFlags& flags, TruthSource& source,
                             std::optional<bool>& geometry) {
  const LabelledMap map = read_labelled_map(flags.map, source.table());
  if (geometry.value_or(map.geometry) != map.geometry)
    throw Error(
        fmt::format("{}: has {} labels, unlike the map before it; give --geometry to score the "
                    "geometry of all, or score them one by one",
                    flags.map.file, map.geometry ? "no" : "its own"));
  geometry = map.geometry;
  note_labels(flags, map.labelling);
  const ScoredMap scored = flags.align ? score_aligned(flags, map, source)
                                       : score_at(flags, map, flags.map.T_map_file(), source);
  if (!scored.score.note.empty()) note(flags, scored.score.note);
  write_errors(flags, scored.map, scored.score, source);
  if (flags.tidy) {
    for (const std::string& line : scored.alignment) note(flags, line);
    return {tidy_table(scored.score)};
  }
  std::vector<Table> tables{class_table(scored.score)};
  tables.front().caption = caption_of(flags, scored.map, scored.score, source);
  for (const std::string& line : scored.alignment) tables.front().caption.push_back(line);
  if (flags.details)
    for (Table& table : detail_tables(scored.score)) tables.push_back(std::move(table));
  return tables;
}

/// Several maps are one table: what there is one of for each map has no place.
void check_several(const ScoreFlags& flags) {
  const std::pair<bool, const char*> of_one[] = {{flags.details, "--details"},
                                                 {!flags.picture.empty(), "--picture"},
                                                 {!flags.errors_ply.empty(), "--errors_ply"}};
  for (const auto& [given, flag] : of_one)
    if (given)
      throw Error(
          fmt::format("{}: is of one map, and {} are given; score them one by one, or with "
                      "--tidy, which prints every figure",
                      flag, flags.maps.size()));
  const auto is_folder = [](const std::string& map) { return std::filesystem::is_directory(map); };
  const auto folders = std::ranges::count_if(flags.maps, is_folder);
  if (folders > 0 && folders < std::ssize(flags.maps))
    throw Error(*std::ranges::find_if(flags.maps, is_folder) +
                ": label images are scored by pixels and maps by voxels; score them apart");
}

void score(const ScoreFlags& all) {
  ScoreFlags flags = all;
  if (flags.align && flags.map.trust_frame)
    throw Error("--trust_frame: keeps the map where it is, and --align moves it; give one of them");
  if (flags.details && flags.format == "csv")
    throw Error("--details: --format csv holds one table; --tidy prints everything as one");
  if (flags.maps.size() > 1) check_several(flags);
  if (!flags.picture.empty()) check_picture_name(flags.picture);
  if (flags.view.view() && flags.picture.empty())
    throw Error("--view: needs --picture, the file that it is drawn into");
  TruthSource source(flags.truth, flags.lattice, flags.work);
  if (!flags.detect.empty()) source.detect(flags.detect);
  std::vector<Table> tables;
  std::optional<bool> geometry;
  for (const std::string& map : flags.maps) {
    flags.map.file = map;
    std::vector<Table> of_map = std::filesystem::is_directory(map)
                                    ? score_label_images(flags, source)
                                    : score_map(flags, source, geometry);
    if (flags.maps.size() == 1) return print(flags, of_map);
    tables.push_back(std::move(of_map.front()));
  }
  print(flags, {tables_beside(flags.maps, tables)});
}

}  // namespace

void add_score(CLI::App& program) {
  const auto [verb, flags] = add_verb<ScoreFlags>(
      program, "score", "Score any map against the truth of a recording or a scene", score);
  verb->add_option("MAP", flags->maps,
                   map_endings() +
                       "; a .csv has i,j,k,class or x,y,z,class; or a folder of label images; "
                       "several: one table")
      ->required();
  flags->map.add_to(*verb);
  verb->add_flag("--align", flags->align,
                 "Move the map to where its geometry fits the truth's surfaces best, if one place "
                 "is clearly the best");
  verb->add_option("--truth", flags->truth, "Recording, or scene (MJCF)")->required();
  verb->add_option("--threshold", flags->threshold,
                   "Least probability of a predicted voxel [0.25; 0 for geometry]")
      ->check(finite_within(0.0, 1.0));
  add_list(
      *verb, "--detect", flags->detect,
      "Classes of pooled, macro, pictures and errors, by commas, or all [the truth's; of label "
      "images: all]");
  verb->add_flag("--details", flags->details,
                 "And distances, probabilities, instances, confusion, free space");
  verb->add_flag("--tidy", flags->tidy, "Everything as one table: class,metric,value");
  add_format_flag(*verb, flags->format);
  verb->add_option("--picture", flags->picture,
                   "PNG: true, near, leak, floating and missed voxels in the scene; of label "
                   "images: the worst frames, with the truth and the errors");
  flags->view.add_to(*verb);
  verb->add_option("--errors_ply", flags->errors_ply, "The same as a coloured point cloud");
  flags->lattice.add_to(*verb);
  flags->work.add_to(*verb);
  verb->footer(
      "Examples:\n"
      "  mapscore score map.ot --truth /data/apartment --details\n"
      "  mapscore score mine.ot theirs.ply voxels.csv --truth /data/apartment\n"
      "  mapscore score rgb.ply --legend legend.yaml --truth /data/apartment\n"
      "  mapscore score octomap.bt --truth scenes/apartment.xml\n"
      "  mapscore score map.ot --truth /data/apartment --picture errors.png --view 4 1 2 5 3 0.8\n"
      "  mapscore score cloud.pcd --transform '1 0 0 0 0 0.7071068 0.7071068' --truth /data/home\n"
      "  mapscore score cloud.ply --align --truth /data/home\n"
      "  mapscore score predicted_labels/ --truth /data/apartment --frames 0:50\n"
      "  mapscore score results/x/networks/HASH --legend results/x/networks/HASH/classes.yaml "
      "--truth /data/home");
}

}  // namespace mapscore::eval
