// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/position_cells.hpp"

#include "core/geometry/voxel.hpp"
#include "core/mapping/draw_set.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace mapscore {
namespace {

constexpr int kReach =
    4096;  ///< cells from the origin of the lattice, so that keys pack into 64 bits
constexpr std::uint32_t kNone = 0xffffffff;

/// Numbers by key: open addressing, linear probing, at most half full.
class CellTable {
 public:
  /// The key's number; `next` where it had none.
  [[nodiscard]] std::uint32_t number_of(std::uint64_t key, std::uint32_t next) {
    Place& place = places_[place_of(key)];
    if (place.number != kNone) return place.number;
    place = {key, next};
    if (2 * ++used_ > places_.size()) grow();
    return next;
  }

 private:
  struct Place {
    std::uint64_t key = 0;
    std::uint32_t number = kNone;
  };

  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    std::size_t place = mix_bits(key) & (places_.size() - 1);
    while (places_[place].number != kNone && places_[place].key != key)
      place = (place + 1) & (places_.size() - 1);
    return place;
  }
  void grow() {
    std::vector<Place> old(2 * places_.size());
    old.swap(places_);
    for (const Place& place : old)
      if (place.number != kNone) places_[place_of(place.key)] = place;
  }

  std::vector<Place> places_ = std::vector<Place>(4096);
  std::size_t used_ = 0;
};

std::vector<ScoredClass> groups_of(const Observation& observation) {
  std::vector<ScoredClass> groups;
  for (const ObservedObject& object : observation)
    groups.push_back({object.class_id, object.score});
  const auto order = [](const ScoredClass& a, const ScoredClass& b) {
    return std::tie(a.class_id, a.score) < std::tie(b.class_id, b.score);
  };
  std::sort(groups.begin(), groups.end(), order);
  groups.erase(std::unique(groups.begin(), groups.end(),
                           [](const ScoredClass& a, const ScoredClass& b) {
                             return a.class_id == b.class_id && a.score == b.score;
                           }),
               groups.end());
  return groups;
}

std::uint16_t group_of(const ObservedObject& object, const std::vector<ScoredClass>& groups) {
  const auto same = [&](const ScoredClass& group) {
    return group.class_id == object.class_id && group.score == object.score;
  };
  return static_cast<std::uint16_t>(std::find_if(groups.begin(), groups.end(), same) -
                                    groups.begin());
}

/// Finds each position's cell, in the order of the observation; makes cells as they turn up.
class CellFinder {
 public:
  /// The lattice: q = R p / edge + offset.
  CellFinder(const Eigen::Matrix3d& R, const Eigen::Vector3d& offset, double edge_m,
             std::vector<PositionCell>& cells)
      : R_(R * (kCellLevels / edge_m)),
        offset_((offset.array() + kReach) * kCellLevels),
        cells_(cells) {}

  /// Levels of a position from the lattice's far corner; none where it is not finite or too far.
  [[nodiscard]] std::optional<std::array<unsigned, 3>> levels(const Eigen::Vector3d& p) const {
    constexpr double kMost = 2.0 * kReach * kCellLevels;
    const Eigen::Vector3d level = R_ * p + offset_;
    const auto within = [](double x) { return x >= 0.0 && x < kMost; };
    if (!within(level.x()) || !within(level.y()) || !within(level.z())) return {};
    return std::array{static_cast<unsigned>(level.x()), static_cast<unsigned>(level.y()),
                      static_cast<unsigned>(level.z())};
  }
  /// Number of the cell that holds these levels.
  [[nodiscard]] std::uint32_t cell_of(const std::array<unsigned, 3>& levels, std::uint16_t group) {
    const unsigned x = levels[0] / kCellLevels, y = levels[1] / kCellLevels,
                   z = levels[2] / kCellLevels;
    constexpr int kBits = 13;
    static_assert(2 * kReach == 1 << kBits);
    const std::uint64_t key = ((std::uint64_t{group} << kBits | x) << kBits | y) << kBits | z;
    if (key == last_key_) return last_cell_;
    last_key_ = key;
    last_cell_ = table_.number_of(key, static_cast<std::uint32_t>(cells_.size()));
    if (last_cell_ == cells_.size())
      cells_.push_back({.low = Eigen::Vector3d(x, y, z).array() - double{kReach}, .group = group});
    return last_cell_;
  }

 private:
  Eigen::Matrix3d R_;  ///< to levels
  Eigen::Vector3d offset_;
  std::vector<PositionCell>& cells_;
  CellTable table_;
  std::uint64_t last_key_ = ~std::uint64_t{0};
  std::uint32_t last_cell_ = 0;
};

/// Numbers the filled parts of all cells, layer by layer. Returns how many there are.
std::uint32_t number_parts(std::vector<PositionCell>& cells) {
  std::uint32_t parts = 0;
  for (PositionCell& cell : cells)
    for (std::size_t z = 0; z < kCellParts; ++z) {
      cell.first_part[z] = parts;
      parts += count_bits(cell.layers[z]);
    }
  return parts;
}

}  // namespace

bool PositionCells::find_cells(const Observation& observation, double edge_m,
                               std::vector<Place>& places) {
  CellFinder finder(R_, offset_, edge_m, cells_);
  for (const ObservedObject& object : observation) {
    const std::uint16_t group = group_of(object, groups_);
    for (const Eigen::Vector3d& p : object.positions) {
      const auto levels = finder.levels(p);
      if (!levels) return false;
      const std::uint32_t number = finder.cell_of(*levels, group);
      PositionCell& cell = cells_[number];
      std::array<unsigned, 3> slice;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const unsigned level = (*levels)[axis] % kCellLevels;
        slice[axis] = level / kPartLevels;
        cell.slices[axis][slice[axis]].extend(static_cast<std::uint8_t>(level));
      }
      cell.layers[slice[2]] |= std::uint64_t{1} << (8 * slice[1] + slice[0]);
      places.push_back(
          {number, static_cast<std::uint16_t>(64 * slice[2] + 8 * slice[1] + slice[0])});
    }
  }
  return true;
}

void PositionCells::sort_parts(const Observation& observation, const std::vector<Place>& places) {
  const std::uint32_t parts = number_parts(cells_);
  part_begin_.assign(parts + 2, 0);
  std::vector<std::uint32_t> part_of(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto& [number, part] = places[n];
    const PositionCell& cell = cells_[number];
    const std::uint64_t before = (std::uint64_t{1} << part % 64) - 1;
    part_of[n] = cell.first_part[part / 64] + count_bits(cell.layers[part / 64] & before);
    ++part_begin_[part_of[n] + 2];
  }
  for (std::size_t part = 2; part < part_begin_.size(); ++part)
    part_begin_[part] += part_begin_[part - 1];
  positions_.resize(places.size());
  std::size_t n = 0;
  for (const ObservedObject& object : observation)
    for (const Eigen::Vector3d& p : object.positions)
      positions_[part_begin_[part_of[n++] + 1]++] = p;
}

std::optional<PositionCells> PositionCells::sort(const Observation& observation,
                                                 const Pose& T_map_sensor, double edge_m) {
  PositionCells sorted;
  constexpr double kAmidPart = 3.5 / kCellParts;
  const Eigen::Vector3d t = T_map_sensor.translation() / edge_m;
  sorted.R_ = T_map_sensor.linear();
  sorted.offset_ = (t - Eigen::Vector3d(t.array().floor())).array() + kAmidPart;
  sorted.groups_ = groups_of(observation);
  if (sorted.groups_.size() > kMostGroups) return {};
  std::size_t positions = 0;
  for (const ObservedObject& object : observation) positions += object.positions.size();
  std::vector<Place> places;
  places.reserve(positions);
  if (!sorted.find_cells(observation, edge_m, places)) return {};
  sorted.sort_parts(observation, places);
  return sorted;
}

}  // namespace mapscore
