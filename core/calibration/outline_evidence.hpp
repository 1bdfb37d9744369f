// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibration_correction.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/sight.hpp"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mapscore {

/// Edges that err together, as an outline wavers and pixels are cut; roughly.
inline constexpr double kEdgesOfAnError = 20.0;

/// The steps of depth that a calibration is found from. A step that lies within its object pulls
/// the estimate the same way in every frame, so more of them are left out than for the segmentation
/// of one frame, and a near object's left side has an edge also where a projector's shadow begins.
inline constexpr DepthEdgeRules kCalibrationEdges{.same_depth = 0.06F, .shadow_ends = true};

/// A depth edge and an outline that lie on each other, as one linear equation of a correction.
struct OutlineEquation {
  double weight = 0;    ///< 0 where the edge lies on no outline
  double residual = 0;  ///< distance beyond where the object should end, px
  /// Of the residual, by the numbers of the correction.
  CalibrationCorrection::Vector slope = CalibrationCorrection::Vector::Zero();
  std::size_t object = 0;  ///< 1 + index of the detection whose outline it is; 0: not known
};

/// How the cameras moved when a frame was seen.
struct FrameMotion {
  /// Velocity of the depth camera in its own optical frame at the depth image's stamp, order x y z
  /// roll pitch yaw (m/s, rad/s).
  Vector6 velocity = Vector6::Zero();
  double lag_s = 0;  ///< the labels were seen so long after the depth image, as their stamps say
};

/// What one frame tells of a calibration: the edges of its depth image near outlines of its masks.
/// Immutable; safe to share between threads.
class OutlineEvidence {
 public:
  /// `reach_px`: how far outlines may lie off their edges.
  OutlineEvidence(const Sight& sight, const std::optional<FrameMotion>& motion, double reach_px);

  [[nodiscard]] int length_px() const { return field_.length_px; }
  [[nodiscard]] std::size_t edges() const { return edges_.size(); }
  [[nodiscard]] std::size_t objects() const { return outlines_.size() - 1; }
  [[nodiscard]] bool moves() const { return motion_.has_value(); }
  /// Mean inverse depth of the edges in the colour camera, 1/m; 0 without edges.
  [[nodiscard]] double mean_inverse_depth() const;

  /// Pixels a second that the robot's motion moves a point in the middle of the image, about 2 m
  /// away; 0 where it is not known.
  [[nodiscard]] double speed_px() const;

  /// By object of this frame (OutlineEquation::object), the object of another frame whose outline
  /// is the same: most of this one's lies within 2 px of outlines there. 0 where there is none.
  [[nodiscard]] std::vector<std::size_t> repeated_in(const OutlineEvidence& other) const;

  /// Outline elements that edges explain, roughly: basins are 8 px wide. Of each `stride`-th edge.
  [[nodiscard]] double coarse_match(const CalibrationCorrection& correction,
                                    std::size_t stride) const;
  /// Outline elements on which edges lie within sigma_px; however many crowd around one, it counts
  /// once.
  [[nodiscard]] double explained(const CalibrationCorrection& correction, float sigma_px) const;
  /// Calls `use` with the equation of each `stride`-th edge that lies near an outline.
  void linearise(const CalibrationCorrection& correction, float sigma_px, std::size_t stride,
                 auto&& use) const {
    const Seen seen(*this, correction);
    for (std::size_t n = 0; n < edges_.size(); n += stride)
      if (const OutlineEquation equation = equation_of(edges_[n], seen, sigma_px);
          equation.weight > 0)
        use(equation);
  }

 private:
  /// A correction at this frame.
  struct Seen {
    Seen(const OutlineEvidence& frame, const CalibrationCorrection& correction);
    Eigen::Matrix3f R;
    Eigen::Vector3f t;
    Eigen::Vector3f pivot;           ///< the start's colour camera, about which turns turn
    Eigen::Vector3f velocity, spin;  ///< of the points in the colour camera, per second
    float fx, fy, cx, cy, offset_px;
    [[nodiscard]] Eigen::Vector2f project(const Eigen::Vector3f& p) const {
      return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
    }
  };
  [[nodiscard]] OutlineEquation equation_of(const ProjectedEdge& edge, const Seen& seen,
                                            float sigma_px) const;

  CameraModel color_;
  std::optional<Vector6> motion_;  ///< of the colour camera by the start
  double lag_s_ = 0;
  OutlineField field_;
  std::vector<std::vector<cv::Point>> outlines_;  ///< by object, the first of none: some pixels
  std::vector<ProjectedEdge> edges_;              ///< by the start
};

}  // namespace mapscore
