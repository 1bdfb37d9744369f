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

constexpr double kReach = 4096.0;  ///< farthest cell index, so that keys pack into 64 bits
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
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
    return places_[place_of(key)].number;
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

/// Index of a cell from -4096 to 4095 on each axis, and of a group.
std::uint64_t key_of(int x, int y, int z, std::uint64_t group) {
  constexpr int kOffset = 1 << 13;
  return group << 48 | static_cast<std::uint64_t>(x + kOffset) << 32 |
         static_cast<std::uint64_t>(y + kOffset) << 16 | static_cast<std::uint64_t>(z + kOffset);
}

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

/// Where one position lies.
struct Sorted {
  std::uint32_t cell;
  std::uint16_t part;                  ///< 64 z + 8 y + x
  std::array<std::uint8_t, 3> levels;  ///< by axis
};

/// Floor for numbers well within the range of int.
int floor_of(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < truncated ? 1 : 0);
}

/// Finds each position's cell, in the order of the observation; makes cells as they turn up.
class CellFinder {
 public:
  CellFinder(const Eigen::Matrix3d& R, const Eigen::Vector3d& offset,
             std::vector<PositionCell>& cells)
      : R_(R), offset_(offset), cells_(cells) {}

  /// False when the position is not finite or too far.
  [[nodiscard]] bool find(const Eigen::Vector3d& p, std::uint16_t group, Sorted& sorted) {
    const Eigen::Vector3d q = R_ * p + offset_;
    if (!(q.cwiseAbs().maxCoeff() < kReach)) return false;
    const int x = floor_of(q.x()), y = floor_of(q.y()), z = floor_of(q.z());
    const std::uint64_t key = key_of(x, y, z, group);
    if (key != last_key_) {
      last_key_ = key;
      last_cell_ = table_.number_of(key, static_cast<std::uint32_t>(cells_.size()));
      if (last_cell_ == cells_.size())
        cells_.push_back({.low = Eigen::Vector3d(x, y, z), .group = group});
    }
    const auto level = [](double offset) {
      return std::min(kCellLevels - 1, static_cast<unsigned>(kCellLevels * offset));
    };
    const unsigned at[3] = {level(q.x() - x), level(q.y() - y), level(q.z() - z)};
    const unsigned row = 8 * (at[1] / kPartLevels) + at[0] / kPartLevels;
    const unsigned layer = at[2] / kPartLevels;
    cells_[last_cell_].layers[layer] |= std::uint64_t{1} << row;
    sorted = {last_cell_,
              static_cast<std::uint16_t>(64 * layer + row),
              {static_cast<std::uint8_t>(at[0]), static_cast<std::uint8_t>(at[1]),
               static_cast<std::uint8_t>(at[2])}};
    return true;
  }

 private:
  Eigen::Matrix3d R_;  ///< over the edge
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
    for (std::size_t z = 0; z < 8; ++z) {
      cell.first_part[z] = parts;
      parts += count_bits(cell.layers[z]);
    }
  return parts;
}

}  // namespace

std::optional<PositionCells> PositionCells::sort(const Observation& observation,
                                                 const Pose& T_map_sensor, double edge_m) {
  PositionCells sorted;
  constexpr double kAmidPart = 3.5 / 8.0;
  const Eigen::Vector3d t = T_map_sensor.translation() / edge_m;
  sorted.R_ = T_map_sensor.linear();
  sorted.offset_ = (t - Eigen::Vector3d(t.array().floor())).array() + kAmidPart;
  sorted.groups_ = groups_of(observation);
  if (sorted.groups_.size() > kMostGroups) return {};
  std::size_t positions = 0;
  for (const ObservedObject& object : observation) positions += object.positions.size();
  std::vector<Sorted> places(positions);
  CellFinder finder(sorted.R_ / edge_m, sorted.offset_, sorted.cells_);
  std::size_t n = 0;
  for (const ObservedObject& object : observation) {
    const std::uint16_t group = group_of(object, sorted.groups_);
    for (const Eigen::Vector3d& p : object.positions)
      if (!finder.find(p, group, places[n++])) return {};
  }
  const std::uint32_t parts = number_parts(sorted.cells_);
  sorted.part_begin_.assign(parts + 2, 0);
  sorted.boxes_.resize(parts);
  std::vector<std::uint32_t> part_of(positions);
  for (n = 0; n < positions; ++n) {
    const auto& [cell, part, levels] = places[n];
    const std::uint64_t below = (std::uint64_t{1} << part % 64) - 1;
    part_of[n] = sorted.cells_[cell].first_part[part / 64] +
                 count_bits(sorted.cells_[cell].layers[part / 64] & below);
    ++sorted.part_begin_[part_of[n] + 2];
    for (std::size_t axis = 0; axis < 3; ++axis)
      sorted.boxes_[part_of[n]][axis].extend(levels[axis]);
  }
  for (std::size_t part = 2; part < sorted.part_begin_.size(); ++part)
    sorted.part_begin_[part] += sorted.part_begin_[part - 1];
  sorted.positions_.resize(positions);
  n = 0;
  for (const ObservedObject& object : observation)
    for (const Eigen::Vector3d& p : object.positions)
      sorted.positions_[sorted.part_begin_[part_of[n++] + 1]++] = p;
  sorted.measure_slices();
  sorted.mark_contested();
  return sorted;
}

void PositionCells::measure_slices() {
  for (PositionCell& cell : cells_)
    for (unsigned z = 0; z < kCellParts; ++z) {
      std::uint32_t part = cell.first_part[z];
      for (std::uint64_t left = cell.layers[z]; left != 0; left &= left - 1, ++part) {
        const auto bit = static_cast<unsigned>(std::countr_zero(left));
        const std::array<unsigned, 3> slice{bit % 8, bit / 8, z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          LevelRange& range = cell.slices[axis][slice[axis]];
          range.extend(boxes_[part][axis].low);
          range.extend(boxes_[part][axis].high);
        }
      }
    }
}

/// Positions in one voxel lie at most two cells apart on each axis as long as the draw's rotation
/// differs from R by less than 0.9 in the sum of a row.
void PositionCells::mark_contested() {
  constexpr int kApart = 2;
  if (groups_.empty() || groups_.front().class_id == groups_.back().class_id) return;
  // Cells of any class by place: 0 none yet, class + 1, or kMany.
  constexpr std::uint32_t kMany = 0x20000;
  std::vector<std::uint32_t> class_at;
  std::vector<std::array<int, 3>> place(cells_.size());
  CellTable table;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) place[c][axis] = static_cast<int>(cells_[c].low[axis]);
    const std::uint32_t number = table.number_of(key_of(place[c][0], place[c][1], place[c][2], 0),
                                                 static_cast<std::uint32_t>(class_at.size()));
    if (number == class_at.size()) class_at.push_back(0);
    const std::uint32_t own = groups_[cells_[c].group].class_id + 1u;
    std::uint32_t& held = class_at[number];
    held = held == 0 || held == own ? own : kMany;
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const std::uint32_t own = groups_[cells_[c].group].class_id + 1u;
    const auto [x, y, z] = place[c];
    for (int dx = -kApart; dx <= kApart && !cells_[c].contested; ++dx)
      for (int dy = -kApart; dy <= kApart && !cells_[c].contested; ++dy)
        for (int dz = -kApart; dz <= kApart && !cells_[c].contested; ++dz) {
          const std::uint32_t number = table.find(key_of(x + dx, y + dy, z + dz, 0));
          cells_[c].contested = number != kNone && class_at[number] != own;
        }
  }
}

}  // namespace mapscore
