// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segment.hpp"

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

namespace mapscore {

/// The largest DBSCAN cluster of a mask's points, down-sampled on cells, as ConceptGraphs cleans
/// its detections (Gu et al., ICRA 2024); docs/methods.md says where they differ.
struct Dbscan {
  static constexpr std::string_view kKind = "dbscan";
  static constexpr std::string_view kMeaning =
      "the largest DBSCAN cluster of a mask's down-sampled points (ConceptGraphs)";
  double cell_m = 0.025;
  double eps_m = 0.05;
  int min_points = 10;

  static void fields(auto& s, auto&& visit) {
    visit(s.cell_m, Field{"cell_m", "edge of a cell, whose points become their mean", {0.001, 10}});
    visit(s.eps_m, Field{"eps_m", "radius of a mean's neighbourhood", {0.001, 10}});
    visit(s.min_points, Field{"min_points",
                              "means in the neighbourhood of a core one, itself included",
                              {1, 1000000}});
  }
  /// As `segment` of segmentation.hpp, which fills in class, instance, score and box.
  [[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                                double voxel_m, bool with_voxels) const;
  bool operator==(const Dbscan&) const = default;
};

inline constexpr int kNoCluster = -1;

/// DBSCAN (Ester et al., KDD 1996): the cluster of each point, or kNoCluster. A point is core when
/// at least `min_points` points, itself among them, lie within `eps_m` of it, limit included. Core
/// points within eps of each other share a cluster; clusters are numbered by their first core
/// point. Another point within eps of a core one joins the first such cluster. Thread-safe.
[[nodiscard]] std::vector<int> dbscan_clusters(std::span<const Eigen::Vector3d> points,
                                               double eps_m, int min_points);

}  // namespace mapscore
