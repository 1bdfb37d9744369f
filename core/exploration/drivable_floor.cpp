// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/drivable_floor.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mapscore {
namespace {

constexpr double kLeastObstacle_m = 0.05, kLowSpace_m = 0.2;
constexpr double kSeenShare = 0.15;
constexpr double kAbout = 3.0;  ///< radii

constexpr int kLeastCubes = 5;
constexpr double kSameSurface_m = 0.125;

/// What the map says of the space above a place.
struct Column {
  int occupied = 0;  ///< cubes
  bool seen = false;
};

/// Columns of cubes up to the robot's height.
class Columns {
 public:
  Columns(const KnownSpace& space, double floor_m, double height_m) : space_(space) {
    const auto above = [&](double z_m) {
      return static_cast<std::int32_t>(std::ceil((floor_m + z_m) / space.edge_m() - 1e-9));
    };
    lowest_obstacle_ = std::max(above(kLeastObstacle_m), space.low().k);
    lowest_seen_ = std::max(above(kLowSpace_m), space.low().k);
    end_ = std::min(above(height_m), space.low().k + space.size().k);
  }

  /// Whether there is a cube of an obstacle in the column, and enough of them about it: fewer are
  /// taken for noise.
  [[nodiscard]] bool obstacle(std::int32_t i, std::int32_t j) const {
    if (at(i, j).occupied == 0) return false;
    int about = 0;
    for (std::int32_t n = 0; n < 9; ++n) about += at(i + n % 3 - 1, j + n / 3 - 1).occupied;
    return about >= kLeastCubes;
  }

  [[nodiscard]] Column at(std::int32_t i, std::int32_t j) const {
    Column column;
    if (!space_.contains({i, j, lowest_obstacle_})) return column;
    int known = 0;
    for (std::int32_t k = lowest_obstacle_; k < end_; ++k) {
      const Space space = space_.at(space_.place_of({i, j, k}));
      column.occupied += space == Space::occupied || space == Space::unsure ? 1 : 0;
      if (k >= lowest_seen_ && space != Space::unknown && space != Space::beyond) ++known;
    }
    column.seen = known >= kSeenShare * (end_ - lowest_seen_);
    return column;
  }

 private:
  const KnownSpace& space_;
  std::int32_t lowest_obstacle_, lowest_seen_, end_;
};

/// Cells that the lidar's beams left out between free ones: five neighbours or more are free, and
/// none is occupied; twice.
OccupancyGrid without_gaps(OccupancyGrid grid) {
  for (int pass = 0; pass < 2; ++pass) {
    const OccupancyGrid before = grid;
    for (GridCell cell; cell.row < grid.frame().height; ++cell.row)
      for (cell.column = 0; cell.column < grid.frame().width; ++cell.column) {
        if (before.at(cell) != kUnknownCell) continue;
        int free = 0, occupied = 0;
        for (int n = 0; n < 9; ++n) {
          const Occupancy beside =
              before.at_or_unknown({cell.column + n % 3 - 1, cell.row + n / 3 - 1});
          free += beside == kFreeCell;
          occupied += beside == kOccupiedCell;
        }
        if (free >= 5 && occupied == 0) grid.set(cell, kFreeCell);
      }
  }
  return grid;
}

void check(const ExplorationState& state) {
  const PlanarPose& T = state.T_map_base;
  if (!(std::isfinite(T.x_m) && std::isfinite(T.y_m) && std::isfinite(T.yaw_rad) &&
        std::isfinite(state.floor_m)))
    throw Error("T_map_base, floor_m: not finite; give the robot's place in metres and radians");
}

/// Calls use(cell) for the cells whose centre lies within a distance of a point.
void for_each_cell_near(const OccupancyGrid& grid, const Eigen::Vector2d& p_map, double within_m,
                        auto&& use) {
  const GridCell middle = grid.cell_of(p_map);
  const auto reach = static_cast<std::int32_t>(std::ceil(within_m / grid.frame().resolution_m));
  for (std::int32_t row = middle.row - reach; row <= middle.row + reach; ++row)
    for (std::int32_t column = middle.column - reach; column <= middle.column + reach; ++column) {
      const GridCell cell{column, row};
      if (grid.contains(cell) && (grid.centre_of(cell) - p_map).norm() <= within_m) use(cell);
    }
}

}  // namespace

DrivableFloor::DrivableFloor(const ExplorationState& state, const ExploringRobot& robot,
                             const KnownSpace& space, Trust trust)
    : grid_(without_gaps(state.floor)), T_map_base_(state.T_map_base), trust_(trust) {
  check(state);
  const Eigen::Vector2d p_base(T_map_base_.x_m, T_map_base_.y_m);
  robot_cell_ = grid_.cell_of(p_base);
  const Columns columns(space, state.floor_m, robot.height_m);
  const std::vector<std::int64_t> from_lidar = squared_distances(grid_);
  const double near = kSameSurface_m / grid_.frame().resolution_m;
  const auto mark = [&](const GridCell& cell) {
    const std::int64_t squared = from_lidar[grid_.index(cell)];
    if (static_cast<double>(squared) > near * near) grid_.set(cell, kOccupiedCell);
  };
  for (GridCell cell; cell.row < grid_.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < grid_.frame().width; ++cell.column) {
      if (grid_.at(cell) == kUnknownCell) continue;
      const Eigen::Vector2d p = grid_.centre_of(cell);
      const VoxelKey key = voxel_of({p.x(), p.y(), state.floor_m}, space.edge_m());
      if (columns.obstacle(key.i, key.j))
        mark(cell);
      else if (trust == Trust::camera_and_lidar && !columns.at(key.i, key.j).seen &&
               grid_.at(cell) == kFreeCell)
        grid_.set(cell, kUnknownCell);
    }
  // Cubes that are smaller than a cell, or whose column holds no centre of one.
  const VoxelKey &low = space.low(), &size = space.size();
  for (std::int32_t i = low.i; i < low.i + size.i; ++i)
    for (std::int32_t j = low.j; j < low.j + size.j; ++j) {
      if (!columns.obstacle(i, j)) continue;
      const GridCell cell = grid_.cell_of({(i + 0.5) * space.edge_m(), (j + 0.5) * space.edge_m()});
      if (grid_.contains(cell)) mark(cell);
    }
  const bool open = grid_.contains(robot_cell_) &&
                    std::sqrt(static_cast<double>(from_lidar[grid_.index(robot_cell_)])) *
                            grid_.frame().resolution_m >=
                        robot.radius_m;
  if (trust == Trust::lidar && open)
    for_each_cell_near(grid_, p_base, kAbout * robot.radius_m, [&](const GridCell& cell) {
      if (grid_.at(cell) == kUnknownCell) grid_.set(cell, kFreeCell);
    });
  for_each_cell_near(grid_, p_base, robot.radius_m - grid_.frame().resolution_m,
                     [&](const GridCell& cell) { grid_.set(cell, kFreeCell); });
  find_clear(robot.radius_m);
}

DrivableFloor::DrivableFloor(OccupancyGrid grid, const PlanarPose& T_map_base, double radius_m)
    : grid_(std::move(grid)),
      T_map_base_(T_map_base),
      robot_cell_(grid_.cell_of({T_map_base.x_m, T_map_base.y_m})) {
  find_clear(radius_m);
}

void DrivableFloor::find_clear(double radius_m) {
  OccupancyGrid blocked = grid_;
  for (GridCell cell; cell.row < grid_.frame().height; ++cell.row)
    for (cell.column = 0; cell.column < grid_.frame().width; ++cell.column)
      if (grid_.at(cell) != kFreeCell) blocked.set(cell, kOccupiedCell);
  clearance_ = squared_distances(blocked);
  const auto squared_cells = [&](double more) {
    const double cells = radius_m / grid_.frame().resolution_m + 0.5 * std::numbers::sqrt2 + more;
    return static_cast<std::int64_t>(std::ceil(cells * cells - 1e-9));
  };
  const std::int64_t narrow = squared_cells(0.0), roomy = squared_cells(0.5);
  clear_.assign(clearance_.size(), 0);
  for (std::size_t n = 0; n < clear_.size(); ++n)
    clear_[n] = clearance_[n] >= roomy ? kRoomy : clearance_[n] >= narrow ? kNarrow : 0;
  if (!grid_.contains(robot_cell_) || clear(robot_cell_)) return;
  const std::int64_t here = squared_clearance(robot_cell_);
  for_each_cell_near(grid_, {T_map_base_.x_m, T_map_base_.y_m}, radius_m,
                     [&](const GridCell& cell) {
                       std::uint8_t& clear = clear_[grid_.index(cell)];
                       if (clear == 0 && squared_clearance(cell) >= here) clear = kNarrow;
                     });
}

}  // namespace mapscore
