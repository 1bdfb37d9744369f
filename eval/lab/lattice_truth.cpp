// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/lattice_truth.hpp"

#include "core/parallel.hpp"
#include "eval/score/curve_score.hpp"
#include "eval/score/distances/thin_score.hpp"
#include "eval/score/reduced_tables.hpp"
#include "eval/score/voxel_score.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace mapscore::eval {
namespace {

/// Depth samples of some images: counted by voxel, and kept for distances.
struct ViewSamples {
  SampleCounter counter;
  SampleCollector points;
};

/// Makes the views of one recording on one lattice. Safe to share between threads.
class ViewMaker {
 public:
  ViewMaker(const Recording& recording, const ClassTable& table, FrameCache& frames,
            const MapFrame& map_frame, const TruthOptions& options, const SurfaceTruth& surface)
      : recording_(recording),
        table_(table),
        frames_(frames),
        map_frame_(map_frame),
        options_(options),
        surface_(surface) {}

  /// Samples of depth images, one after the other.
  [[nodiscard]] ViewSamples samples_of(std::span<const int> images) const {
    ViewSamples samples{SampleCounter(map_frame_.edge_m),
                        SampleCollector(table_.classes.size(), map_frame_.edge_m)};
    for (const int image : images) add(*frames_.get_depth(image), samples);
    return samples;
  }

  [[nodiscard]] ViewTruth view_of(ViewSamples&& samples, int jobs) const {
    return {visible_truth(samples.counter, surface_, options_.min_samples),
            samples.points.take(jobs)};
  }

 private:
  void add(const Frame& frame, ViewSamples& samples) const {
    const Calibration& calibration = recording_.info().calibration;
    const Pose T_map_base = map_frame_.T_map_world() * frame.T_world_base;
    samples.counter.add(frame, calibration, table_, T_map_base);
    if (options_.distances) append(frame, calibration, T_map_base, samples.points);
  }

  /// Samples of the detected classes in the map frame.
  void append(const Frame& frame, const Calibration& calibration, const Pose& T_map_base,
              SampleCollector& points) const {
    const Pose T_map_depth = T_map_base * calibration.T_base_depth;
    for (int v = 0; v < frame.depth.rows; ++v) {
      for (int u = 0; u < frame.depth.cols; ++u) {
        const ClassId class_id = table_.class_of(frame.depth_label(v, u));
        const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
        if (!table_.detected(class_id) || z == 0.0 || z < calibration.range_min_m ||
            z > calibration.range_max_m)
          continue;
        points.add(class_id, T_map_depth * calibration.depth.back_project(u, v, z));
      }
    }
  }

  const Recording& recording_;
  const ClassTable& table_;
  FrameCache& frames_;
  const MapFrame& map_frame_;
  const TruthOptions& options_;
  const SurfaceTruth& surface_;
};

/// The depth images that the view is made of, each once.
std::vector<int> depth_images(const Recording& recording, const TruthOptions& options) {
  if (options.depth_image) return {*options.depth_image};
  std::vector<int> images;
  for (const int frame : options.frames.of(recording.frame_count()))
    images.push_back(recording.depth_of(frame));
  images.erase(std::unique(images.begin(), images.end()), images.end());
  return images;
}

/// Each job takes images that follow each other, so that the samples come in their order.
ViewTruth view_of_all(const ViewMaker& maker, std::span<const int> images, int jobs) {
  const std::size_t shares = std::clamp<std::size_t>(images.size(), 1, std::max(jobs, 1));
  std::vector<std::optional<ViewSamples>> samples(shares);
  run_jobs(static_cast<int>(shares), [&](int job) {
    const auto share = static_cast<std::size_t>(job);
    const std::size_t first = images.size() * share / shares;
    const std::size_t last = images.size() * (share + 1) / shares;
    samples[share] = maker.samples_of(images.subspan(first, last - first));
  });
  ViewSamples all = *std::exchange(samples.front(), std::nullopt);
  for (std::size_t share = 1; share < shares; ++share) {
    all.counter.merge(samples[share]->counter);
    all.points.append(std::move(samples[share]->points));
    samples[share].reset();
  }
  return maker.view_of(std::move(all), jobs);
}

}  // namespace

ViewTruth whole_surface_view(const SurfaceTruth& surface, std::size_t class_count) {
  return {whole_surface(surface), SampleCollector(class_count, surface.edge_m()).take()};
}

Counts LatticeTruth::score(const MapSnapshot& map, double threshold, const ViewTruth& view_truth,
                           std::size_t class_count, const ScoreOptions& options, int jobs) const {
  Counts counts = score_voxels(map, threshold, surface, view_truth.visible, class_count, options);
  std::vector<ClassCurve> curves = curves_of(map, surface, view_truth.visible, class_count);
  for (std::size_t c = 0; c < class_count; ++c) counts[c].curve = std::move(curves[c]);
  if (!options.distances_m.empty())
    score_distances(map, threshold, distance_to_class, view_truth.samples, options, counts, jobs);
  if (options.asked.thin)
    score_thin(map, threshold, surface, view_truth.visible, {distance_to_class, distance_to_thin},
               counts);
  return counts;
}

LatticeTruth make_surface_truth(const std::vector<Shape>& shapes, const ClassTable& table,
                                const MapFrame& map_frame, const TruthOptions& options, int jobs) {
  const Pose T_map_world = map_frame.T_map_world();
  LatticeTruth truth;
  truth.surface =
      surface_truth(shapes, table, T_map_world, {map_frame.edge_m, options.epsilon_m, jobs});
  truth.distance_to_class = cube_distance(prepare(shapes, T_map_world), table, map_frame.edge_m);
  truth.distance_to_thin =
      mapscore::eval::distance_to_thin(shapes, table, T_map_world, map_frame.edge_m);
  return truth;
}

ViewTruth make_view(const Recording& recording, const ClassTable& table, FrameCache& frames,
                    const MapFrame& map_frame, const TruthOptions& options,
                    const SurfaceTruth& surface, int jobs) {
  const ViewMaker maker(recording, table, frames, map_frame, options, surface);
  return view_of_all(maker, depth_images(recording, options), jobs);
}

LatticeTruth make_lattice_truth(const Recording& recording, const ClassTable& table,
                                FrameCache& frames, const MapFrame& map_frame,
                                const TruthOptions& options, int jobs) {
  const RecordedShapes shapes = shapes_of(recording);
  LatticeTruth truth = make_surface_truth(shapes.at(options.at_s), table, map_frame, options, jobs);
  truth.view = make_view(recording, table, frames, map_frame, options, truth.surface, jobs);
  return truth;
}

}  // namespace mapscore::eval
