// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/truth_source.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/results/study_store.hpp"
#include "eval/study/grid.hpp"
#include "eval/truth/truth_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <numbers>
#include <unordered_set>

namespace mapscore::eval {
namespace {

/// Memory that programs can have without others being swapped out, as Linux tells it; infinite on a
/// system that does not.
double available_bytes() {
  std::ifstream memory("/proc/meminfo");
  for (std::string word; memory >> word;)
    if (double kib = 0; word == "MemAvailable:" && memory >> kib) return 1024 * kib;
  return std::numeric_limits<double>::infinity();
}

void check_truth_size(const TruthCost& cost, double edge_m, bool yes) {
  if (!yes) refuse_too_large(cost, edge_m, available_bytes());
}

/// Whether two tables agree in all that decides a truth: what is detected, and the class of each
/// instance.
bool same_truth(const ClassTable& a, const ClassTable& b) {
  return std::ranges::equal(a.classes, b.classes, {}, &SemanticClass::detect,
                            &SemanticClass::detect) &&
         std::ranges::equal(a.instances, b.instances, {}, &Instance::class_id, &Instance::class_id);
}

/// The time given by the flags, if any.
std::optional<double> time_of(const LatticeFlags& flags, const Recording& recording) {
  if (!flags.frame) return flags.at_s;
  if (flags.at_s) throw Error("--frame: stands beside --at_s; both say a time, keep one");
  if (*flags.frame >= recording.frame_count())
    throw Error(fmt::format("--frame: {} is not in the recording; it has frames 0 to {}",
                            *flags.frame, recording.frame_count() - 1));
  return recording.depth_stamp_s(recording.depth_of(*flags.frame));
}

}  // namespace

void add_yes_flag(CLI::App& verb, bool& yes, const char* help) {
  verb.add_flag("--yes", yes, help);
}

void LatticeFlags::add_to(CLI::App& verb) {
  verb.add_option("--voxel_m", voxel_m, "Voxel edge in metres [0.05]")
      ->check(finite_within(1e-4, 100.0));
  add_without_voxel_to(verb);
}

void LatticeFlags::add_without_voxel_to(CLI::App& verb) {
  verb.add_option("--origin_m", origin_m, "Origin of the map frame in the world: x y z [0 0 0]")
      ->expected(3)
      ->check(finite_within(-1e6, 1e6));
  verb.add_option("--yaw_deg", yaw_deg, "Heading of the map frame in the world [0]")
      ->check(finite_within(-360, 360));
  verb.add_option("--epsilon_m", epsilon_m, "How far a cube is widened on each side [0.0005]")
      ->check(finite_within(0.0, 1.0));
  verb.add_option("--min_samples", min_samples, "Depth samples that make a voxel visible [1]")
      ->check(CLI::Range(1, 1000000));
  verb.add_option("--at_s", at_s, "Where things move: the time whose surfaces count, seconds")
      ->check(finite_within(-1e12, 1e12));
  verb.add_option("--frame", frame, "The same, as the frame at whose depth stamp that is, from 0")
      ->check(CLI::NonNegativeNumber);
  add_yes_flag(verb, yes);
  verb.add_option("--frames", frames,
                  "Frames of the recording that count: 3,7,9 or first:end:step, from 0, without "
                  "end [all]");
}

MapFrame LatticeFlags::map_frame() const {
  return {voxel_m,
          {origin_m.at(0), origin_m.at(1), origin_m.at(2)},
          yaw_deg * std::numbers::pi / 180.0};
}

TruthSource::TruthSource(const std::string& source, const LatticeFlags& lattice,
                         const WorkFlags& work)
    : lattice_(lattice), jobs_(work.jobs) {
  if (std::filesystem::path(source).extension() == ".xml") {
    if (lattice.frames || lattice.frame || lattice.at_s)
      throw Error("--frames, --frame, --at_s: " + source +
                  " is a scene and has no frames; give a recording");
    if (lattice.min_samples != LatticeFlags().min_samples)
      throw Error("--min_samples: " + source + " is a scene and has no samples; leave it out");
    SceneSurfaces scene = surfaces_of_scene(source);
    table_ = std::move(scene.table);
    shapes_ = std::move(scene.shapes);
    return;
  }
  if (std::filesystem::is_regular_file(source))
    throw Error(source + ": neither a recording's folder nor a scene (.xml); give one of these");
  recording_.emplace(Recording::open(source));
  if (!recording_->info().has_truth)
    throw Error(source +
                ": the recording has no truth/; only maps of rendered recordings can be scored");
  if (lattice.frames) selection_ = FrameSelection(*lattice.frames);
  table_ = recording_->info().table;
  const RecordedShapes shapes = shapes_of(*recording_);
  if (shapes.poses.empty() && (lattice.frame || lattice.at_s))
    throw Error(fmt::format("--{}: nothing moves in {}, so no time matters; leave it out",
                            lattice.frame ? "frame" : "at_s", source));
  shapes_ = shapes.at(time_of(lattice, *recording_));
  frames_.emplace(*recording_,
                  Channels{.color = false, .label = false, .depth = true, .depth_label = true},
                  work.memory_bytes);
}

void TruthSource::detect(const std::vector<std::string>& classes) {
  table_ = detected_table(classes, std::move(table_));
}

LatticeTruth TruthSource::surfaces(const ClassTable& table, const TruthOptions& options,
                                   bool whole_view) const {
  const MapFrame map_frame = lattice_.map_frame();
  TruthCost cost =
      truth_cost(shapes_, map_frame.T_map_world(), {map_frame.edge_m, options.epsilon_m});
  if (whole_view) cost.bytes += cost.whole_view;
  check_truth_size(cost, map_frame.edge_m, lattice_.yes);
  return {surfaces_of(shapes_, table, map_frame, options.epsilon_m, jobs_), {}};
}

SurfaceTruth TruthSource::surface() const {
  return surfaces(table_, {.epsilon_m = lattice_.epsilon_m}, false).surface;
}

LatticeTruth TruthSource::truth(const ClassTable& table, bool distances) {
  const MapFrame map_frame = lattice_.map_frame();
  const TruthOptions options{.epsilon_m = lattice_.epsilon_m,
                             .min_samples = lattice_.min_samples,
                             .distances = distances,
                             .frames = selection_};
  LatticeTruth truth = surfaces(table, options, !recording_);
  if (recording_)
    truth.view = make_view(*recording_, table, *frames_, map_frame, options, truth.surface, jobs_);
  else
    truth.view = whole_surface_view(truth.surface, table.classes.size());
  return truth;
}

std::shared_ptr<const LatticeTruth> TruthSource::kept_truth(const ClassTable& table,
                                                            bool distances) {
  Kept& kept = kept_.at(distances ? 1 : 0);
  if (kept.truth && same_truth(kept.table, table)) return kept.truth;
  kept.truth.reset();  // before the next, which may be as large
  kept = {table, std::make_shared<const LatticeTruth>(truth(table, distances))};
  return kept.truth;
}

std::vector<Eigen::Vector3d> TruthSource::seen_points() {
  constexpr int kEvery_px = 2, kMostFrames = 400;
  constexpr double kCell_m = 0.02;  // of points in one cell, its centre
  if (!recording_) return {};
  std::unordered_set<std::uint64_t> cells;
  const Calibration& calibration = recording_->info().calibration;
  const int frames = recording_->frame_count(), step = (frames + kMostFrames - 1) / kMostFrames;
  for (int index = 0; index < frames; index += step) {
    const auto frame = frames_->get_depth(recording_->depth_of(index));
    const Pose T_map_depth =
        lattice_.map_frame().T_map_world() * frame->T_world_base * calibration.T_base_depth;
    for (int v = 0; v < frame->depth.rows; v += kEvery_px)
      for (int u = 0; u < frame->depth.cols; u += kEvery_px)
        if (const double z_m = frame->depth(v, u) / kDepthUnitsPerMetre; z_m > 0)
          if (const auto cell = packable_voxel_of(
                  T_map_depth * calibration.depth.back_project(u, v, z_m), kCell_m))
            cells.insert(pack(*cell));
  }
  std::vector<Eigen::Vector3d> points;
  for (const std::uint64_t cell : cells) points.push_back(centre_of(unpack(cell), kCell_m));
  return points;
}

const SurfaceAligner& TruthSource::aligner() {
  if (!aligner_)
    aligner_.emplace(prepare(shapes_, lattice_.map_frame().T_map_world()), jobs_, seen_points());
  return *aligner_;
}

OccupancyTruth TruthSource::occupancy(const SurfaceTruth& surface) {
  return make_occupancy_truth(*frames_, frames(), recording_->info().calibration,
                              lattice_.map_frame().T_map_world(), surface, lattice_.min_samples,
                              jobs_);
}

void check_truth_size(const Study& study, const Recording& recording, std::size_t trials,
                      bool yes) {
  Study finest = study;
  for (const Cell& cell : cells(study))
    if (const Study at = resolve(study, cell); at.voxel_m < finest.voxel_m || cell.index == 0)
      finest = at;
  const MapFrame frame = map_frame(finest, 0);
  TruthCost cost = truth_cost(shapes_of(recording).shapes, frame.T_map_world(),
                              {finest.voxel_m, finest.score.epsilon_m});
  const std::size_t lattices = study.map_origin_m ? 1 : static_cast<std::size_t>(study.seeds);
  cost.bytes *= static_cast<double>(std::min({lattices, trials, TruthCache::kLeastLattices}));
  check_truth_size(cost, finest.voxel_m, yes);
}

}  // namespace mapscore::eval
