// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_files.hpp"

#include "core/error.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/recording/recording.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr const char* kCurveHead =
    "stamp_s,driven_m,views,coverage,coverage_detected,precision,recall,f1,known_m3\n";
constexpr std::size_t kCurveColumns = 9, kMapColumns = 4;

std::string how_to_mend(const fs::path& folder) {
  return fmt::format("remove {} to explore it anew", shown(folder));
}

[[noreturn]] void fail_on(const fs::path& file, const std::string& problem) {
  throw Error(fmt::format("{}: {}; {}", shown(file), problem, how_to_mend(file.parent_path())));
}

/// Of a recording its content hash.
std::string hash_at(const fs::path& file) {
  return fs::is_directory(file) ? Recording::open(file).content_hash() : hash_of(read_file(file));
}

/// Hashes of what an exploration's folder holds, by name: all but what is measured, and run.yaml,
/// which lists them.
std::map<std::string, std::string> hashes_in(const fs::path& folder) {
  std::map<std::string, std::string> hashes;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == kRunFile || name == kTimesFile) continue;
    hashes[name] = hash_at(entry.path());
  }
  return hashes;
}

/// What read() gives; to an Error of it how to mend it is added.
auto or_anew(const fs::path& folder, auto&& read) try {
  return read();
} catch (const Error& error) {
  throw Error(fmt::format("{}; or {}", error.what(), how_to_mend(folder)));
}

/// Refuses a folder of which a file is missing or not as it was written.
void check_files_of(const fs::path& folder, const YamlValue& run) {
  const auto hashes = or_anew(folder, [&] { return run.at("files").entries(); });
  for (const auto& [name, hash] : hashes) {
    const fs::path file = folder / name;
    if (!fs::exists(file)) fail_on(file, "is missing");
    const std::string now = or_anew(folder, [&] { return hash_at(file); });
    if (now != hash.text()) fail_on(file, "is not as it was written");
  }
}

/// What run.yaml says; without the curve.
KeptExploration totals_of(const YamlValue& run) {
  constexpr std::uint64_t kMost = 1ULL << 40;
  const auto count = [&](const char* key) {
    return static_cast<std::size_t>(run.at(key).whole(0, kMost));
  };
  const std::string end = run.at("end").text();
  constexpr auto kEnds = names_of(ExplorationEnd{});
  if (std::ranges::find(kEnds, end) == kEnds.end())
    run.at("end").fail(fmt::format("is {}; write one of {}", end, fmt::join(kEnds, ", ")));
  return {run.at("key").text(),
          end,
          run.at("reason").text(),
          run.at("driven_m").number(),
          run.at("duration_s").number(),
          count("views"),
          count("frames"),
          count("bump_contacts"),
          {}};
}

std::string run_text(const ExplorationResult& result, const std::string& key,
                     const std::map<std::string, std::string>& hashes) {
  std::string text = fmt::format(
      "key: {}\nend: {}\nreason: {}\ndriven_m: {}\nduration_s: {}\nviews: {}\nframes: {}\n"
      "bump_contacts: {}\n",
      key, word_of(result.end), yaml_text(result.reason), result.driven_m, result.duration_s,
      result.views.size(), result.frames.size(), result.bump_contacts);
  if (result.objects)
    text += fmt::format("objects: {}\nobjects_missed: {}\nobjects_found_again: {}\n",
                        result.objects->kept, result.objects->missed, result.objects->found_again);
  text += "files:\n";
  for (const auto& [name, hash] : hashes) text += fmt::format("  {}: \"{}\"\n", name, hash);
  return text;
}

std::string views_text(const std::vector<ChosenView>& views) {
  std::string text =
      "stamp_s,driven_m,x_m,y_m,yaw_deg,way_m,unknown_voxels,unsure_voxels,end,obstacle\n";
  for (const ChosenView& view : views) {
    const PlanarPose& T = view.T_world_base;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", view.stamp_s, view.driven_m, T.x_m,
                        T.y_m, T.yaw_rad * kDegreesPerRadian, view.way_m, view.unknown_voxels,
                        view.unsure_voxels, word_of(view.end), csv_cell(view.obstacle));
  }
  return text;
}

std::string way_text(const std::vector<TrajectoryPose>& frames) {
  std::string text = "stamp_s,x_m,y_m,yaw_deg\n";
  for (const TrajectoryPose& frame : frames) {
    const PlanarPose T = planar(frame.T_world_base);
    text +=
        fmt::format("{},{},{},{}\n", frame.stamp_s, T.x_m, T.y_m, T.yaw_rad * kDegreesPerRadian);
  }
  return text;
}

/// The last moment not beyond each share of the way, each once; the last of them is the end.
std::vector<const FloorMoment*> kept_moments(const ExplorationResult& result) {
  std::vector<const FloorMoment*> kept;
  for (std::size_t n = 1; n <= kKeptMoments && !result.moments.empty(); ++n) {
    const double until_m =
        result.driven_m * static_cast<double>(n) / static_cast<double>(kKeptMoments);
    const FloorMoment* last = &result.moments.front();
    for (const FloorMoment& moment : result.moments)
      if (moment.driven_m <= until_m || n == kKeptMoments) last = &moment;
    if (kept.empty() || kept.back() != last) kept.push_back(last);
  }
  return kept;
}

void write_moments(const ExplorationResult& result, const fs::path& folder) {
  std::string moments = "moment,stamp_s,driven_m\n", frontiers = "moment,x_map_m,y_map_m\n";
  const std::vector<const FloorMoment*> kept = kept_moments(result);
  for (std::size_t n = 0; n < kept.size(); ++n) {
    save_grid(kept[n]->floor, folder / fmt::format("floor_{}.yaml", n + 1));
    moments += fmt::format("{},{},{}\n", n + 1, kept[n]->stamp_s, kept[n]->driven_m);
    for (const Eigen::Vector2d& p : kept[n]->frontier)
      frontiers += fmt::format("{},{},{}\n", n + 1, p.x(), p.y());
  }
  write_file(folder / kMomentsFile, moments);
  write_file(folder / kFrontiersFile, frontiers);
}

CoveragePoint point_of(const std::vector<std::string>& cells, const std::string& file,
                       std::size_t line) {
  std::vector<double> numbers;
  for (const std::string& cell : cells)
    if (const auto number = parse_number(cell)) numbers.push_back(*number);
  const bool scored = numbers.size() == kCurveColumns;
  if (!scored && numbers.size() != kCurveColumns - kMapColumns)
    throw Error(fmt::format("{}:{}: is no line of a curve; {}", file, line,
                            how_to_mend(fs::path(file).parent_path())));
  CoveragePoint point{numbers[0], numbers[1], static_cast<int>(numbers[2]),
                      numbers[3], numbers[4], std::nullopt};
  if (scored) point.map = MapState{numbers[5], numbers[6], numbers[7], numbers[8]};
  return point;
}

}  // namespace

std::string curve_text(const ExplorationCurve& curve) {
  std::string text = kCurveHead;
  for (const CoveragePoint& point : curve) {
    text += fmt::format("{},{},{},{},{}", point.stamp_s, point.driven_m, point.views,
                        point.coverage, point.coverage_detected);
    text += point.map ? fmt::format(",{},{},{},{}\n", point.map->precision, point.map->recall,
                                    point.map->f1, point.map->known_m3)
                      : ",-,-,-,-\n";
  }
  return text;
}

ExplorationCurve curve_of_text(const std::string& text, const std::string& file) {
  if (!text.starts_with(kCurveHead)) fail_on(file, "is no curve of an exploration");
  ExplorationCurve curve;
  TextLines lines(text);
  static_cast<void>(lines.next());
  while (const auto line = lines.next()) {
    const auto cells = csv_cells(*line, kCurveColumns);
    curve.push_back(point_of(cells.value_or(std::vector<std::string>{}), file, lines.number()));
  }
  if (curve.empty()) fail_on(file, "holds no point");
  return curve;
}

void write_exploration(const ExplorationResult& result, const std::string& key,
                       const fs::path& folder) {
  write_file(folder / kCurveFile, curve_text(result.curve));
  write_file(folder / kViewsFile, views_text(result.views));
  write_file(folder / kWayFile, way_text(result.frames));
  write_moments(result, folder);
  write_file(folder / kTimesFile,
             fmt::format("plans,plans_s,slowest_plan_s\n{},{},{}\n", result.moments.size(),
                         result.plans_s, result.slowest_plan_s));
  write_file(folder / kRunFile, run_text(result, key, hashes_in(folder)));
}

std::optional<std::string> key_of_exploration(const fs::path& folder) {
  if (!fs::exists(folder / kRunFile)) return std::nullopt;
  return or_anew(folder, [&] { return load_yaml(folder / kRunFile).at("key").text(); });
}

std::optional<KeptExploration> read_exploration(const fs::path& folder) {
  if (!fs::exists(folder / kRunFile)) return std::nullopt;
  const YamlValue run = or_anew(folder, [&] { return load_yaml(folder / kRunFile); });
  KeptExploration kept = or_anew(folder, [&] { return totals_of(run); });
  check_files_of(folder, run);
  const fs::path curve = folder / kCurveFile;
  kept.curve = curve_of_text(read_file(curve), curve.string());
  if (kept.curve.size() != kept.frames)
    fail_on(curve, fmt::format("holds {} points, and {} says {} frames", kept.curve.size(),
                               kRunFile, kept.frames));
  return kept;
}

}  // namespace mapscore::eval
