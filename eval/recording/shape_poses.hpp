// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Where the shapes that move are at each depth image; all others stay where they are.
struct ShapePoses {
  std::vector<std::size_t> shapes;  ///< positions of those that move, ascending
  std::vector<double> stamps_s;     ///< of the depth images
  std::vector<Pose> T_world_shape;  ///< by stamp, then in the order of `shapes`

  [[nodiscard]] bool empty() const { return shapes.empty(); }
  /// Position of the stamp nearest in time, the earlier of two equally near; needs a stamp.
  [[nodiscard]] std::size_t nearest(double stamp_s) const;
  /// Those of `all` that move, at a stamp's position.
  [[nodiscard]] std::vector<Shape> moved(const std::vector<Shape>& all, std::size_t at) const;
  /// Those of `all` that stay.
  [[nodiscard]] std::vector<Shape> fixed(const std::vector<Shape>& all) const;
  /// All of them at a stamp's position, in their order.
  [[nodiscard]] std::vector<Shape> at(std::vector<Shape> all, std::size_t at) const;
};

/// The shapes among `all` that leave their place at any of the stamps. `T_world_shape`: of all
/// shapes, one list a stamp.
[[nodiscard]] ShapePoses poses_of_moving(const std::vector<Shape>& all,
                                         std::vector<double> stamps_s,
                                         const std::vector<std::vector<Pose>>& T_world_shape);

/// As the recording's files hold them: primitives first, then meshes, whose triangles lie in the
/// world, so that their poses are those that carry them there from where they were.
[[nodiscard]] ShapePoses as_filed(const ShapePoses& poses, const std::vector<Shape>& all);

/// truth/poses.csv: a line for each stamp and moving shape. Throws Error when a pose is not finite.
[[nodiscard]] std::string shape_poses_text(const ShapePoses& poses);

/// Throws Error with file and line when the file is missing, a line is not of the format, names no
/// shape below `shape_count`, or stamps and shapes are not those of every depth image in turn.
[[nodiscard]] ShapePoses read_shape_poses(const std::filesystem::path& file,
                                          std::size_t shape_count,
                                          const std::vector<double>& depth_stamps_s);

}  // namespace mapscore::eval
