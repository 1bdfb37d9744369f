// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/segmentation/calibration_evidence.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>

namespace mapscore {

/// Correction of the believed registration for one frame, p_color = rotation *
/// (T_believed_color_depth p_depth) + translation, seen with focal lengths `focal` times those
/// believed, and the error of the masks' size: objects end where the signed distance to the mask's
/// outline is `offset_px` (positive: masks too small).
struct OutlineAlignment {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  float focal = 1;  ///< of the colour camera, over the believed one
  float offset_px = 0;
  float sharpness = 1;  ///< `score` at sigma 1.2 px over that at 4 px: near 1 for a rigid scene
  float score = 0;      ///< share of the outline that depth edges explain at sigma 1.5 px, 0 to 1

  /// The scene moved as one, and the masks' outlines are right to about a pixel.
  [[nodiscard]] bool is_sharp() const { return sharpness > 0.85F; }

  /// The calibration with the correction.
  [[nodiscard]] Calibration corrected(const Calibration& believed) const {
    Calibration mended = believed;
    const Eigen::Matrix3d R = rotation.cast<double>();
    mended.T_color_depth.linear() = R * believed.T_color_depth.linear();
    mended.T_color_depth.translation() =
        R * believed.T_color_depth.translation() + translation.cast<double>();
    mended.color.fx_px *= static_cast<double>(focal);
    mended.color.fy_px *= static_cast<double>(focal);
    return mended;
  }
};

/// The fits of a frame's outlines.
struct OutlineFits {
  OutlineAlignment mended;    ///< with the correction that explains most
  OutlineAlignment believed;  ///< without one: of the masks' size alone
  /// What other frames are judged by; none where edges show nothing of the masks.
  std::shared_ptr<const FittedFrame> frame = {};
};

/// Probability that a fit by align_outlines is right: that across the outlines it leaves less than
/// 2 px, root mean square, between the masks and where their objects are. A logistic regression on
/// what it explains, of how much outline, and how sharply, in images of 640 x 480 (which ones:
/// docs/segmentation.md). `outline_px`: OutlineField::length_px.
[[nodiscard]] double confidence_of(const OutlineAlignment& fit, int outline_px);

/// The correction that a frame was fitted with by align_outlines; none of another method's.
[[nodiscard]] std::optional<OutlineAlignment> correction_of(const FittedFrame& frame);

/// Fits the outlines of a frame to its depth edges.
[[nodiscard]] OutlineFits align_outlines(const DepthEdges& edges, const OutlineField& field,
                                         const Calibration& believed, double search_px);

/// The same where the believed registration is right: only the masks' size is fitted.
[[nodiscard]] OutlineAlignment fit_mask_size(const DepthEdges& edges, const OutlineField& field,
                                             const Calibration& believed);

}  // namespace mapscore
