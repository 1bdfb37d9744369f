// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/lattice_truth.hpp"

#include "core/parallel.hpp"
#include "eval/lab/detected_samples.hpp"
#include "eval/score/distances/thin_score.hpp"
#include "eval/score/voxel_score.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace mapscore::eval {
namespace {

/// Depth samples of some images: counted by voxel, and kept for distances.
struct ViewSamples {
  SampleCounter counter;
  SampleCollector points;
};

/// Takes samples from the depth images of one recording, on one lattice. Safe to share between
/// threads.
struct Sampler {
  const Calibration& calibration;
  const ClassTable& table;
  FrameCache& frames;
  const MapFrame& map_frame;
  bool distances;  ///< keep the points too

  /// Samples of depth images, one after the other.
  [[nodiscard]] ViewSamples samples_of(std::span<const int> images) const {
    ViewSamples samples{SampleCounter(map_frame.edge_m),
                        SampleCollector(table.classes.size(), map_frame.edge_m)};
    for (const int image : images) {
      const std::shared_ptr<const Frame> frame = frames.get_depth(image);
      const Pose T_map_base = map_frame.T_map_world() * frame->T_world_base;
      samples.counter.add(*frame, calibration, table, T_map_base);
      if (distances) append(*frame, T_map_base * calibration.T_base_depth, samples.points);
    }
    return samples;
  }

  /// Samples of the detected classes in the map frame.
  void append(const Frame& frame, const Pose& T_map_depth, SampleCollector& points) const {
    const Eigen::Matrix3d R = T_map_depth.linear();
    const Eigen::Vector3d t = T_map_depth.translation();
    for_each_detected_sample(frame, calibration, table,
                             [&](ClassId class_id, const Eigen::Vector3d& p_depth) {
                               points.add(class_id, R * p_depth + t);
                             });
  }
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
ViewSamples samples_of_all(const Sampler& sampler, std::span<const int> images, int jobs) {
  const std::size_t shares = std::clamp<std::size_t>(images.size(), 1, std::max(jobs, 1));
  std::vector<std::optional<ViewSamples>> samples(shares);
  run_jobs(static_cast<int>(shares), [&](int job) {
    const auto share = static_cast<std::size_t>(job);
    const std::size_t first = images.size() * share / shares;
    const std::size_t last = images.size() * (share + 1) / shares;
    samples[share] = sampler.samples_of(images.subspan(first, last - first));
  });
  ViewSamples all = *std::exchange(samples.front(), std::nullopt);
  for (std::size_t share = 1; share < shares; ++share) {
    all.counter.merge(samples[share]->counter);
    all.points.append(std::move(samples[share]->points));
    samples[share].reset();
  }
  return all;
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

ViewTruth make_view(const Recording& recording, const ClassTable& table, FrameCache& frames,
                    const MapFrame& map_frame, const TruthOptions& options,
                    const SurfaceTruth& surface, int jobs) {
  const Sampler sampler{recording.info().calibration, table, frames, map_frame, options.distances};
  ViewSamples samples = samples_of_all(sampler, depth_images(recording, options), jobs);
  return {visible_truth(samples.counter, surface, options.min_samples), samples.points.take(jobs)};
}

}  // namespace mapscore::eval
