// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

namespace mapscore {

/// Pixel whose registered point region growing starts at (docs/methods.md).
enum class SeedRule {
  box_centre,     ///< middle of the box, rounded down, whether or not it lies on the mask [M]
  mask_centroid,  ///< mask pixel with a point nearest to the mask's centroid, ties in row-major
                  ///< order
  largest_piece,  ///< likewise, of the largest piece of the mask that is continuous in depth
  depth_mode  ///< pixel farthest inside the mask, at the depth shared by most of its medial axis
};

constexpr auto names_of(SeedRule) {
  return std::to_array<std::string_view>(
      {"box_centre", "mask_centroid", "largest_piece", "depth_mode"});
}

/// Pixels side by side (4 neighbours) belong to one piece when their depths differ by at most this
/// share of the nearer one.
inline constexpr double kPieceStep = 0.03;
/// The mode is the window [z, (1 + kModeWidth) z] that holds most of the medial axis.
inline constexpr double kModeWidth = 0.06;

/// The seed point in depth_optical (metres); none when the rule finds no pixel with a point.
[[nodiscard]] std::optional<Eigen::Vector3d> seed_point(const Detection& detection,
                                                        const RegisteredCloud& cloud,
                                                        SeedRule rule);

}  // namespace mapscore
