// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/edge_aligned.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"
#include "core/segmentation/edge_aligned/settled_depth.hpp"
#include "core/segmentation/edge_aligned/surface_creases.hpp"
#include "core/segmentation/edge_aligned/surface_vote.hpp"
#include "core/segmentation/occupied_centres.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

constexpr double kSharpReach = 2.0 / 3.0;  // of the reach: outlines are right to a pixel

/// What is fitted to what.
struct Outlined {
  DepthEdges edges;
  Continuity on;  ///< of the depth image's surfaces
  OutlineField field;
};

Outlined outlined(const Sight& sight, const EdgeAligned& params) {
  const Calibration& believed = sight.believed();
  DepthEdges edges = find_depth_edges(sight.depth(), believed);
  Continuity on{edges.right, edges.down};
  if (!is_noisy(edges)) {
    on = part_at_creases(edges);
    const std::vector<DepthEdge> contacts = contacts_of(edges, on, believed.depth);
    edges.steps.insert(edges.steps.end(), contacts.begin(), contacts.end());
  }
  const int reach_px = static_cast<int>(std::ceil(1.3 * params.search_px)) + 16;
  return {std::move(edges), std::move(on),
          outline_field(sight.detections(), believed.color.width_px, believed.color.height_px,
                        reach_px)};
}

/// A correction of the calibration, with the size of this frame's masks.
OutlineAlignment with_size_fitted(const OutlineAlignment& correction, const DepthEdges& edges,
                                  const OutlineField& field, const Calibration& believed) {
  const OutlineAlignment size = fit_mask_size(edges, field, correction.corrected(believed));
  OutlineAlignment fitted = correction;
  fitted.offset_px = size.offset_px;
  fitted.sharpness = size.sharpness;
  fitted.score = size.score;
  return fitted;
}

}  // namespace

std::shared_ptr<const FittedFrame> fitted(const Sight& sight, const EdgeAligned& params) {
  check_ranges(params);
  if (!mends_calibration(params, sight.believed())) return nullptr;
  const Outlined frame = outlined(sight, params);
  return align_outlines(frame.edges, frame.field, sight.believed(), params.search_px).frame;
}

LabelledDepth label_surfaces(const Sight& sight, const EdgeAligned& params) {
  check_ranges(params);
  const Calibration& believed = sight.believed();
  auto [edges, on, field] = outlined(sight, params);
  LabelledDepth labelled;
  if (!mends_calibration(params, believed)) {
    labelled.alignment = fit_mask_size(edges, field, believed);
    labelled.is_known = true;
  } else {
    const OutlineFits fits = align_outlines(edges, field, believed, params.search_px);
    labelled.alignment = fits.mended;
    labelled.fit = fits.frame;
    const FrameVerdict verdict = fits.frame ? sight.told().judge(*fits.frame) : FrameVerdict();
    if (verdict.stands) labelled.alignment = fits.believed;
    if (verdict.agreed)
      labelled.alignment =
          with_size_fitted(correction_of(*verdict.agreed).value(), edges, field, believed);
    labelled.is_known = verdict.stands || verdict.agreed;
    labelled.confidence = confidence_of(labelled.alignment, field.length_px);
  }
  const OutlineShifts shifts =
      find_outline_shifts(edges, field, labelled.alignment, believed, labelled.is_known);
  const double reach =
      labelled.alignment.is_sharp() ? kSharpReach * params.reach_px : params.reach_px;
  labelled.labels = vote_on_surfaces(edges, open_grooves(std::move(field)), labelled.alignment,
                                     shifts, believed, sight.detections().size(), on, reach);
  if (is_noisy(edges)) labelled.inverse_depth = settle_on_surfaces(edges, labelled.labels);
  return labelled;
}

std::vector<Segment> EdgeAligned::segment(const Sight& sight, double voxel_m,
                                          bool with_voxels) const {
  const LabelledDepth labelled = label_surfaces(sight, *this);
  const cv::Mat1w& depth = sight.depth();
  std::vector<Segment> segments;
  segments.reserve(sight.detections().size());
  for (const Detection& detection : sight.detections()) {
    Segment& segment = segments.emplace_back();
    segment.class_id = detection.class_id;
    segment.instance = detection.instance;
    segment.score = detection.score;
    segment.confidence = labelled.confidence;
    segment.fit = labelled.fit;
  }
  const DepthRays rays(sight.believed().depth);
  for (int v = 0; v < depth.rows; ++v) {
    const std::uint16_t *label = labelled.labels[v], *units = depth[v];
    const float* settled = labelled.inverse_depth.empty() ? nullptr : labelled.inverse_depth[v];
    for (int u = 0; u < depth.cols; ++u) {
      if (label[u] == 0) continue;
      Segment& segment = segments[label[u] - std::size_t{1}];
      const double z_m = settled == nullptr ? units[u] / kDepthUnitsPerMetre
                                            : 1.0 / static_cast<double>(settled[u]);
      segment.points.push_back(rays.point(u, v, z_m));
      segment.box.extend(segment.points.back());
    }
  }
  for (Segment& segment : segments) {
    if (segment.points.empty()) segment.skipped = SkipReason::no_points;
    if (with_voxels) segment.voxel_centres = occupied_centres(segment.points, voxel_m);
  }
  return segments;
}

}  // namespace mapscore
