// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/lattice_truth.hpp"

#include "eval/score/voxel_score.hpp"

#include <exception>
#include <utility>

namespace mapscore::eval {
namespace {

/// Depth samples of the detected classes in the map frame, by class.
using SamplePoints = std::vector<std::vector<Eigen::Vector3d>>;

void append_samples(const Frame& frame, const Calibration& calibration, const ClassTable& table,
                    const Pose& T_map_base, SamplePoints& points) {
  const Pose T_map_depth = T_map_base * calibration.T_base_depth;
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const ClassId class_id = table.class_of(frame.depth_label(v, u));
      const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (!table.detected(class_id) || z == 0.0 || z < calibration.range_min_m ||
          z > calibration.range_max_m)
        continue;
      points[class_id].push_back(T_map_depth * calibration.depth.back_project(u, v, z));
    }
  }
}

/// Makes the truth of the views, one frame at a time.
class ViewMaker {
 public:
  ViewMaker(const Recording& recording, const ClassTable& table, const MapFrame& map_frame,
            const TruthOptions& options, const SurfaceTruth& surface)
      : recording_(recording),
        table_(table),
        map_frame_(map_frame),
        T_map_world_(map_frame.T_map_world()),
        options_(options),
        surface_(surface),
        counter_(map_frame.edge_m),
        points_(table.classes.size()) {}

  void add(const Frame& frame) {
    const Calibration& calibration = recording_.info().calibration;
    const Pose T_map_base = T_map_world_ * frame.T_world_base;
    counter_.add(frame, calibration, table_, T_map_base);
    if (options_.distances) append_samples(frame, calibration, table_, T_map_base, points_);
  }

  /// The view of all frames added since the last call.
  ViewTruth take() {
    ViewTruth view;
    view.visible = visible_truth(counter_, surface_, options_.min_samples);
    view.samples = SampleSet(points_, map_frame_.edge_m);
    counter_ = SampleCounter(map_frame_.edge_m);
    for (auto& of_class : points_) of_class.clear();
    return view;
  }

 private:
  const Recording& recording_;
  const ClassTable& table_;
  const MapFrame& map_frame_;
  const Pose T_map_world_;
  const TruthOptions& options_;
  const SurfaceTruth& surface_;
  SampleCounter counter_;
  SamplePoints points_;
};

}  // namespace

Counts LatticeTruth::score(const MapSnapshot& map, double threshold, const ViewTruth& view_truth,
                           std::size_t class_count, const ScoreOptions& options) const {
  Counts counts = score_voxels(map, threshold, surface, view_truth.visible, class_count, options);
  if (!options.distances_m.empty())
    score_distances(map, threshold, distance_to_class, view_truth.samples, options, counts);
  return counts;
}

LatticeTruth make_surface_truth(const std::vector<Shape>& shapes, const ClassTable& table,
                                const MapFrame& map_frame, const TruthOptions& options, int jobs) {
  const Pose T_map_world = map_frame.T_map_world();
  LatticeTruth truth;
  truth.surface =
      surface_truth(shapes, table, T_map_world, {map_frame.edge_m, options.epsilon_m, jobs});
  truth.distance_to_class = cube_distance(prepare(shapes, T_map_world), table, map_frame.edge_m);
  return truth;
}

LatticeTruth make_lattice_truth(const Recording& recording, const ClassTable& table,
                                FrameCache& frames, const MapFrame& map_frame,
                                const TruthOptions& options, int jobs) {
  LatticeTruth truth = make_surface_truth(recording.read_shapes(), table, map_frame, options, jobs);
  ViewMaker maker(recording, table, map_frame, options, truth.surface);
  for (int index = 0; index < recording.frame_count(); ++index) {
    maker.add(*frames.get(index));
    if (options.by_frame) truth.views.push_back(maker.take());
  }
  if (!options.by_frame) truth.views.push_back(maker.take());
  return truth;
}

TruthCache::TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
                       std::size_t capacity)
    : recording_(recording), table_(table), frames_(frames), capacity_(capacity) {}

std::shared_ptr<const LatticeTruth> TruthCache::get(const MapFrame& map_frame,
                                                    const TruthOptions& options) {
  std::promise<Truth> promise;
  std::shared_future<Truth> truth = promise.get_future().share();
  {
    std::unique_lock lock(mutex_);
    for (const Entry& entry : entries_) {
      if (!(entry.map_frame == map_frame && entry.options == options)) continue;
      truth = entry.truth;
      lock.unlock();
      return truth.get();
    }
    entries_.push_front({map_frame, options, truth});
    if (entries_.size() > capacity_) entries_.pop_back();
  }
  try {
    constexpr int kOneJob = 1;  // the threads that ask are the parallelism
    promise.set_value(std::make_shared<const LatticeTruth>(
        make_lattice_truth(recording_, table_, frames_, map_frame, options, kOneJob)));
  } catch (...) {
    promise.set_exception(std::current_exception());
  }
  return truth.get();
}

}  // namespace mapscore::eval
