// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/geometry/posed_depth.hpp"
#include "core/objects/object_box.hpp"
#include "core/segmentation/detection.hpp"

#include <Eigen/Core>
#include <array>

namespace mapscore {

/// Planar depths between which the ray of a pixel is within a box; none where in_m > out_m.
struct DepthInterval {
  double in_m = 1.0, out_m = 0.0;
  [[nodiscard]] bool empty() const { return !(in_m <= out_m); }
};

/// A box as rays see it that start at the origin of the camera's frame. Immutable.
class BoxRays {
 public:
  /// `box`: in the camera's frame. Depths are cut to near_m .. far_m.
  BoxRays(const ObjectBox& box, double near_m, double far_m)
      : half_m_(0.5 * box.size_m),
        R_box_camera_(box.T_frame_box.linear().transpose()),
        origin_m_(-(R_box_camera_ * box.T_frame_box.translation())),
        near_m_(near_m),
        far_m_(far_m) {}

  /// Of the ray through z * (x, y, 1), z > 0: the slab test on each axis of the box. Exact up to
  /// rounding; the box is closed.
  [[nodiscard]] DepthInterval at(double x, double y) const {
    DepthInterval interval{near_m_, far_m_};
    for (int axis = 0; axis < 3; ++axis) {
      double slope =
          R_box_camera_(axis, 0) * x + (R_box_camera_(axis, 1) * y + R_box_camera_(axis, 2));
      slope = slope == 0.0 ? 1e-300 : slope;  // along the slab: within it everywhere or nowhere
      const double inverse = 1.0 / slope;
      const double a = (-half_m_[axis] - origin_m_[axis]) * inverse;
      const double b = (half_m_[axis] - origin_m_[axis]) * inverse;
      const double low = a < b ? a : b, high = a < b ? b : a;
      interval.in_m = low > interval.in_m ? low : interval.in_m;
      interval.out_m = high < interval.out_m ? high : interval.out_m;
    }
    return interval;
  }

 private:
  Eigen::Vector3d half_m_;
  Eigen::Matrix3d R_box_camera_;
  Eigen::Vector3d origin_m_;
  double near_m_, far_m_;
};

/// Pixels of the image outside which no ray meets the box (in the camera's frame) at a depth of
/// near_m or more: bounds of its part beyond near_m, a pixel wider. Empty (width or height below 1)
/// where there are none.
[[nodiscard]] PixelBox pixels_of(const ObjectBox& box, const CameraModel& camera, double near_m);

/// Area of the box's outline in the image plane, also beyond the image, in pixels; infinite where
/// it reaches nearer than near_m.
[[nodiscard]] double outline_px(const ObjectBox& box, const CameraModel& camera, double near_m);

/// What a camera frames between two planar depths: the closed hexahedron from the outer edges of
/// its outer pixels (u = -1/2 and width - 1/2, v likewise). Camera's frame, metres. Immutable.
class Frustum {
 public:
  /// 0 < near_m <= far_m.
  Frustum(const CameraModel& camera, double near_m, double far_m);

  /// True when the box, in the camera's frame, and the frustum have a point in common: no axis
  /// separates them, of the normals of both and the products of their edges (separating axis
  /// theorem, which is exact for convex bodies).
  [[nodiscard]] bool meets(const ObjectBox& box) const;

 private:
  std::array<Eigen::Vector3d, 8> corners_;  ///< of the near plane, then of the far one
  std::array<Eigen::Vector3d, 5> normals_;
  std::array<Eigen::Vector3d, 6> edges_;
};

/// Pixels of a depth image whose rays meet a box within the camera's range, counted by where the
/// measured depth lies relative to the box. The depth image serves as z-buffer [N].
struct BoxVotes {
  int within = 0;           ///< in the box: the object may still be there
  int occluded = 0;         ///< in front of the box: something hides it
  int beyond = 0;           ///< behind the box: the ray passed through it
  int unmeasured = 0;       ///< pixels without depth
  double outline_px = 0.0;  ///< area of the box in the image plane, also beyond the image

  /// Pixels that measured the box's place: neither hidden nor without depth.
  [[nodiscard]] int looked() const { return within + beyond; }
  bool operator==(const BoxVotes&) const = default;
};

/// Votes of every pixel; `box` in the map frame. A measured depth z votes `occluded` when z < in -
/// tolerance, `beyond` when z > out + tolerance, else `within`; in and out: depths at which the
/// pixel's ray enters and leaves the box, cut to the camera's range. Nothing when the box is
/// outside the frustum.
[[nodiscard]] BoxVotes vote(const ObjectBox& box, const PosedDepth& view, double tolerance_m);

/// When a camera should have detected an object.
struct Visibility {
  double tolerance_m = 0.02;  ///< of vote()
  int min_pixels = 100;       ///< least BoxVotes::looked()
  double min_share = 0.5;     ///< least BoxVotes::looked() over outline_px
};

/// True when enough of the box was in view: not hidden, not outside the image or the range.
[[nodiscard]] bool should_be_seen(const BoxVotes& votes, const Visibility& visibility);

}  // namespace mapscore
