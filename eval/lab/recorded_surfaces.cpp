// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/recorded_surfaces.hpp"

#include "core/error.hpp"
#include "eval/score/distances/thin_score.hpp"

#include <fmt/format.h>

#include <utility>

namespace mapscore::eval {

std::size_t RecordedShapes::image_at(std::optional<double> at_s) const {
  const double first_s = poses.stamps_s.front(), last_s = poses.stamps_s.back();
  if (!at_s)
    throw Error(fmt::format(
        "the recording's scene moves: say at which time its surfaces count, from {} to {} s "
        "(score.at_s of a study; --at_s or --frame), or score frame by frame (score.unit)",
        first_s, last_s));
  if (*at_s < first_s || *at_s > last_s)
    throw Error(fmt::format("at_s: {} is outside the recording; give a time from {} to {} s", *at_s,
                            first_s, last_s));
  return poses.nearest(*at_s);
}

std::vector<Shape> RecordedShapes::at(std::optional<double> at_s) const {
  return poses.empty() ? shapes : poses.at(shapes, image_at(at_s));
}

RecordedShapes shapes_of(const Recording& recording) {
  return {recording.read_shapes(), recording.read_poses()};
}

SurfacesAt surfaces_of(const std::vector<Shape>& shapes, const ClassTable& table,
                       const MapFrame& map_frame, double epsilon_m, int jobs) {
  const Pose T_map_world = map_frame.T_map_world();
  return {surface_truth(shapes, table, T_map_world, {map_frame.edge_m, epsilon_m, jobs}),
          cube_distance(prepare(shapes, T_map_world), table, map_frame.edge_m),
          distance_to_thin(shapes, table, T_map_world, map_frame.edge_m)};
}

RecordedSurfaces::RecordedSurfaces(const RecordedShapes& shapes, const ClassTable& table,
                                   const MapFrame& map_frame, double epsilon_m, int jobs)
    : shapes_(shapes), table_(table), map_frame_(map_frame) {
  if (shapes.poses.empty()) {
    still_ = surfaces_of(shapes.shapes, table, map_frame, epsilon_m, jobs);
    return;
  }
  moving_ = std::make_unique<const MovingSurface>(
      shapes.poses.fixed(shapes.shapes), table, map_frame.T_map_world(),
      SurfaceOptions{map_frame.edge_m, epsilon_m, jobs});
  fixed_distances_ = class_distances(moving_->fixed_pieces(), table);
}

SurfacesAt RecordedSurfaces::at(std::optional<double> at_s) const {
  if (!moving_) return still_;
  const std::vector<Shape> moved = shapes_.poses.moved(shapes_.shapes, shapes_.image_at(at_s));
  const std::vector<PreparedShape> pieces = prepare(moved, map_frame_.T_map_world());
  ClassDistances distances = fixed_distances_;
  for (const SemanticClass& c : table_.classes) {
    std::vector<PreparedShape> of_class = pieces_of(pieces, table_, c.id);
    if (of_class.empty()) continue;
    for (PreparedShape& piece : pieces_of(moving_->fixed_pieces(), table_, c.id))
      of_class.push_back(std::move(piece));
    distances[c.id] = std::make_shared<const SurfaceDistance>(std::move(of_class));
  }
  return {moving_->at(moved), cube_distance(std::move(distances), map_frame_.edge_m),
          distance_to_thin(shapes_.at(at_s), table_, map_frame_.T_map_world(), map_frame_.edge_m)};
}

}  // namespace mapscore::eval
