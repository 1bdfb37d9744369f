// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "core/mapping/observation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mapscore {

/// Objects of one class and one score: within a draw they count as one.
struct ScoredClass {
  ClassId class_id = kBackground;
  double score = 0.0;
};

/// Parts of a cell on each axis, and levels that its coordinates are told apart by.
inline constexpr unsigned kCellParts = 8;
inline constexpr unsigned kPartLevels = 16;
inline constexpr unsigned kCellLevels = kCellParts * kPartLevels;

/// Lowest and highest level with positions, of kCellLevels from a cell's low side.
struct LevelRange {
  std::uint8_t low = 255, high = 0;

  void extend(std::uint8_t level) {
    low = std::min(low, level);
    high = std::max(high, level);
  }
};

/// A cube of one voxel's edge, cut into 8 x 8 x 8 parts, and which of them hold positions of one
/// group.
struct PositionCell {
  Eigen::Vector3d low;  ///< low corner, in voxels, in the turned sensor frame
  std::array<std::uint64_t, kCellParts> layers{};  ///< by z: bit 8 y + x is set on filled parts
  std::array<std::array<LevelRange, kCellParts>, 3> slices{};  ///< by axis, across it
  std::array<std::uint32_t, kCellParts> first_part{};  ///< of each layer; parts follow by y, x
  std::uint16_t group = 0;
};

/// The positions of an observation, sorted into cells of a lattice that turns with the sensor:
/// q = R p / edge + offset. R is the rotation of one draw, and the offset puts the map's boundaries
/// in that draw amid the cells' parts. Made once a frame, read by each draw.
class PositionCells {
 public:
  /// Most groups that are told apart.
  static constexpr std::size_t kMostGroups = 64;

  /// Empty where the observation does not suit: more groups, a position that is not finite, or one
  /// farther than 4096 cells from the others.
  [[nodiscard]] static std::optional<PositionCells> sort(const Observation& observation,
                                                         const Pose& T_map_sensor, double edge_m);

  [[nodiscard]] const std::vector<ScoredClass>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<PositionCell>& cells() const { return cells_; }
  /// Positions in the sensor frame (metres) of one filled part.
  [[nodiscard]] std::span<const Eigen::Vector3d> part(std::uint32_t index) const {
    return std::span(positions_)
        .subspan(part_begin_[index], part_begin_[index + 1] - part_begin_[index]);
  }
  [[nodiscard]] const Eigen::Matrix3d& R() const { return R_; }
  [[nodiscard]] const Eigen::Vector3d& offset() const { return offset_; }

 private:
  /// Where one position lies.
  struct Place {
    std::uint32_t cell;
    std::uint16_t part;  ///< 64 z + 8 y + x
  };

  [[nodiscard]] bool find_cells(const Observation& observation, double edge_m,
                                std::vector<Place>& places);
  void sort_parts(const Observation& observation, const std::vector<Place>& places);

  Eigen::Matrix3d R_;
  Eigen::Vector3d offset_;
  std::vector<ScoredClass> groups_;  ///< ascending by class, then score
  std::vector<PositionCell> cells_;
  std::vector<std::uint32_t> part_begin_;
  std::vector<Eigen::Vector3d> positions_;
};

}  // namespace mapscore
