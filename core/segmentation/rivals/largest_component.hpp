// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/registered_cloud.hpp"
#include "core/segmentation/segment.hpp"

#include <array>
#include <string_view>

namespace mapscore {

/// Which connected components of a mask's points are its object.
enum class KeptComponents { largest, all };
constexpr auto names_of(KeptComponents) {
  return std::to_array<std::string_view>({"largest", "all"});
}

/// Connected components of occupied cells, as the object detector of Khronos forms them (Schmid,
/// Abate, Chang, Carlone, RSS 2024), of each mask by itself; docs/methods.md says where they
/// differ.
struct LargestComponent {
  static constexpr std::string_view kKind = "largest_component";
  static constexpr std::string_view kMeaning =
      "the largest connected component of the cells that a mask's points occupy (Khronos)";
  double cell_m = 0.1;
  int min_points = 50;
  KeptComponents keep = KeptComponents::largest;

  static void fields(auto& s, auto&& visit) {
    visit(s.cell_m, Field{"cell_m", "edge of a cell", {0.001, 10}});
    visit(s.min_points,
          Field{"min_points", "components with fewer points are dropped", {1, 1000000}});
    visit(s.keep, Field{"keep", "which of the others are kept"});
  }
  /// As `segment` of segmentation.hpp, which fills in class, instance, score and box.
  [[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                                double voxel_m, bool with_voxels) const;
  bool operator==(const LargestComponent&) const = default;
};

}  // namespace mapscore
