// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/shape.hpp"
#include "core/mapping/semantic_map.hpp"
#include "eval/score/distances/sample_set.hpp"
#include "eval/truth/sample_counter.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstdint>
#include <vector>

namespace mapscore::eval::testing {

/// Scenes a property is looked at in, their classes, and the threshold of what a map predicts.
inline constexpr std::uint64_t kScenes = 1000;
inline constexpr std::size_t kClasses = 4;
inline constexpr double kThreshold = 0.25;

/// A heap of a few shapes within half a metre of the origin, of all kinds: some anywhere, some on
/// the lattice, some against, in or across the one before. Two instances of each of three detected
/// classes, and background.
struct RandomScene {
  ClassTable table;
  std::vector<Shape> shapes;
  double edge_m = 0.0, epsilon_m = 0.0;

  [[nodiscard]] SurfaceTruth surface() const;
};

/// `dyadic`: the edge and all positions are multiples of powers of two that doubles add exactly.
[[nodiscard]] RandomScene random_scene(std::uint64_t seed, bool dyadic = false);

/// A camera's frame and where the camera stood: depth images of some 300 pixels.
struct RandomView {
  Frame frame;
  Pose T_map_camera = Pose::Identity();
};
[[nodiscard]] Calibration view_calibration();

/// Four cameras around the scene. Each pixel sees the first voxel of the surface on its ray, mostly
/// with an instance of a class that is there. `one_class`: only voxels that a single class touches
/// are seen, with that class.
[[nodiscard]] std::vector<RandomView> random_views(const SurfaceTruth& surface, std::uint64_t seed,
                                                   bool one_class = false);

[[nodiscard]] SampleCounter counted(const RandomScene& scene, const std::vector<RandomView>& views);

/// Positions in the map of the samples of each class.
using Points = std::vector<std::vector<Eigen::Vector3d>>;
[[nodiscard]] Points points_of(const RandomScene& scene, const std::vector<RandomView>& views);

/// A map made from the truth: voxels moved, dropped, relabelled and added with random
/// probabilities, each with a probability in eighths, some known to be free.
[[nodiscard]] std::vector<MapVoxel> random_map(const SurfaceTruth& surface, std::uint64_t seed);

/// The surface without the voxels that several classes touch.
[[nodiscard]] SurfaceTruth of_one_class(const SurfaceTruth& surface);

}  // namespace mapscore::eval::testing
