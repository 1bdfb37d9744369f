// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/edge_aligned/depth_edges.hpp"
#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/edge_aligned/outline_field.hpp"
#include "core/segmentation/edge_aligned/outline_shifts.hpp"
#include "core/segmentation/edge_aligned/surface_creases.hpp"

#include <opencv2/core.hpp>

namespace mapscore::testing {

// The steps of edge_aligned, pixel by pixel as their definitions say, which the core must equal.

/// Continuity and steps of an image whose inverse depth, noise and near holes are given.
[[nodiscard]] DepthEdges plain_steps(const DepthEdges& given, const Calibration& believed,
                                     const DepthEdgeRules& rules = {});

[[nodiscard]] EdgeMatch plain_match(const OutlineField& field, const EdgeAt& edge,
                                    const MatchRules& rules);

[[nodiscard]] OutlineShifts plain_shifts(const DepthEdges& edges, const OutlineField& field,
                                         const OutlineAlignment& alignment,
                                         const Calibration& believed);

[[nodiscard]] Continuity plain_creases(const DepthEdges& edges);

/// Of images without near holes.
[[nodiscard]] cv::Mat1w plain_surface_votes(const DepthEdges& edges, const MaskField& masks,
                                            const OutlineAlignment& alignment,
                                            const OutlineShifts& shifts,
                                            const Calibration& believed, std::size_t detections,
                                            float reach_px);

[[nodiscard]] cv::Mat1f settle_plainly(const DepthEdges& edges, cv::Mat1w& labels);

}  // namespace mapscore::testing
