// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/geometry/shape.hpp"
#include "eval/truth/shapes/convex_forms.hpp"

#include <vector>

namespace mapscore::eval {

/// What counts as contact, metres: well above the rounding of coordinates below a kilometre, well
/// below anything that is drawn. Closed tests take the box wider by it on each side, open ones
/// narrower, so that faces that lie on the lattice, or on each other, in decimal numbers do so in
/// doubles too.
inline constexpr double kContact_m = 1e-10;

/// One convex piece of the drawn surfaces in the map frame: a primitive, or one triangle of a mesh.
/// Immutable, safe to share between threads.
class PreparedShape {
 public:
  PreparedShape(Form form, bool solid, int shape, InstanceId instance);

  [[nodiscard]] const Form& form() const { return form_; }
  /// True when the piece has an inside.
  [[nodiscard]] bool solid() const { return solid_; }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Position of the shape that it is a piece of.
  [[nodiscard]] int shape() const { return shape_; }
  [[nodiscard]] InstanceId instance() const { return instance_; }

 private:
  Form form_;
  bool solid_;
  int shape_;
  InstanceId instance_;
  Box bounds_;
};

/// Pieces of all shapes in the map frame, in the order of the shapes and of their triangles. Throws
/// Error naming the shape when its pose or size is not finite or a size that its kind needs is not
/// positive.
[[nodiscard]] std::vector<PreparedShape> prepare(const std::vector<Shape>& shapes,
                                                 const Pose& T_map_world);

/// True when the closed box meets the surface: the boundary of a solid, all of a plane or triangle.
/// Contact counts.
[[nodiscard]] bool meets_surface(const PreparedShape& shape, const Box& box);

/// True when the closed box meets the closed solid; contact counts. Never for planes and triangles.
[[nodiscard]] bool meets_solid(const PreparedShape& shape, const Box& box);

/// True when the closed box lies in the open interior of the solid; contact from inside does not
/// count. Never for planes and triangles.
[[nodiscard]] bool inside_open(const PreparedShape& shape, const Box& box);

/// True when the open box meets the surface. An open box misses a closed surface exactly when no
/// closed box within it meets it, so this is the closed test of the box drawn in by the contact.
[[nodiscard]] bool open_meets_surface(const PreparedShape& shape, const Box& box);

/// The box moved outwards by `margin_m` on each side.
[[nodiscard]] inline Box widened(const Box& box, double margin_m) {
  return {(box.min().array() - margin_m).matrix(), (box.max().array() + margin_m).matrix()};
}

}  // namespace mapscore::eval
