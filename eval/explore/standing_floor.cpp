// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "eval/explore/standing_floor.hpp"

#include "sim/robot/clearance.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mapscore::eval {
namespace {

constexpr double kMostPlaces = 1e6;
constexpr std::int32_t kOpen = -1;  ///< a place without a part yet

bool can_stand(sim::Clearance& clearance, const Eigen::Vector2d& p) {
  const PlanarPose along_x{p.x(), p.y(), 0.0}, along_y{p.x(), p.y(), 0.5 * std::numbers::pi};
  return !clearance.obstacle_at(along_x) && clearance.floor_at(along_x) &&
         clearance.floor_at(along_y);
}

}  // namespace

StandingFloor::StandingFloor(const sim::DriveModel& drive, const Eigen::AlignedBox2d& bounds) {
  if (bounds.isEmpty()) return;
  while (bounds.sizes().prod() / (step_m_ * step_m_) > kMostPlaces) step_m_ *= 2.0;
  const auto lattice = [&](double x_m) {
    return static_cast<std::int64_t>(std::floor(x_m / step_m_));
  };
  first_column_ = lattice(bounds.min().x());
  first_row_ = lattice(bounds.min().y());
  columns_ = static_cast<std::size_t>(lattice(bounds.max().x()) - first_column_ + 1);
  rows_ = static_cast<std::size_t>(lattice(bounds.max().y()) - first_row_ + 1);
  part_of_.assign(columns_ * rows_, 0);
  sim::Clearance clearance(drive);
  for (std::size_t cell = 0; cell < part_of_.size(); ++cell)
    if (can_stand(clearance, place(cell))) part_of_[cell] = kOpen;
  label_parts();
}

StandingFloor StandingFloor::with_room(std::size_t steps) const {
  StandingFloor roomy = *this;
  const auto stands = [&](std::size_t column, std::size_t row) {
    return column < columns_ && row < rows_ && part_of_[row * columns_ + column] != 0;
  };
  for (std::size_t cell = 0; cell < part_of_.size(); ++cell) {
    bool has_room = part_of_[cell] != 0;
    // Beyond the low end the difference is a great number, beyond the lattice too.
    for (std::size_t i = 0; i <= 2 * steps && has_room; ++i)
      for (std::size_t j = 0; j <= 2 * steps && has_room; ++j)
        has_room = stands(cell % columns_ + i - steps, cell / columns_ + j - steps);
    roomy.part_of_[cell] = has_room ? kOpen : 0;
  }
  roomy.label_parts();
  return roomy;
}

Eigen::Vector2d StandingFloor::place(std::size_t cell) const {
  return {static_cast<double>(first_column_ + static_cast<std::int64_t>(cell % columns_)) * step_m_,
          static_cast<double>(first_row_ + static_cast<std::int64_t>(cell / columns_)) * step_m_};
}

void StandingFloor::label_parts() {
  part_sizes_.assign(1, 0);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t cell) {
    if (part_of_[cell] != kOpen) return;
    part_of_[cell] = static_cast<std::int32_t>(part_sizes_.size()) - 1;
    ++part_sizes_.back();
    open.push_back(cell);
  };
  for (std::size_t seed = 0; seed < part_of_.size(); ++seed) {
    if (part_of_[seed] != kOpen) continue;
    part_sizes_.push_back(0);
    reach(seed);
    while (!open.empty()) {
      const std::size_t cell = open.back(), column = cell % columns_, row = cell / columns_;
      open.pop_back();
      if (column > 0) reach(cell - 1);
      if (column + 1 < columns_) reach(cell + 1);
      if (row > 0) reach(cell - columns_);
      if (row + 1 < rows_) reach(cell + columns_);
    }
  }
}

std::vector<Eigen::Vector2d> StandingFloor::part(std::int32_t number) const {
  std::vector<Eigen::Vector2d> places;
  if (number == 0) return places;
  for (std::size_t cell = 0; cell < part_of_.size(); ++cell)
    if (part_of_[cell] == number) places.push_back(place(cell));
  return places;
}

std::vector<Eigen::Vector2d> StandingFloor::connected_to(const Eigen::Vector2d& start) const {
  std::int32_t number = 0;
  double nearest_m = 2.0 * step_m_;
  for (std::size_t cell = 0; cell < part_of_.size(); ++cell) {
    const double distance_m = (place(cell) - start).norm();
    if (part_of_[cell] == 0 || distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    number = part_of_[cell];
  }
  return part(number);
}

std::vector<Eigen::Vector2d> StandingFloor::largest() const {
  if (part_sizes_.empty()) return {};
  return part(
      static_cast<std::int32_t>(std::ranges::max_element(part_sizes_) - part_sizes_.begin()));
}

std::vector<Eigen::Vector2d> StandingFloor::thinned(const std::vector<Eigen::Vector2d>& places,
                                                    double step_m, std::size_t least) const {
  const auto every = std::max<std::int64_t>(1, std::llround(step_m / step_m_));
  std::vector<Eigen::Vector2d> kept;
  for (const Eigen::Vector2d& p : places)
    if (std::llround(p.x() / step_m_) % every == 0 && std::llround(p.y() / step_m_) % every == 0)
      kept.push_back(p);
  return kept.size() < least ? places : kept;
}

RobotExtent extent_of(const sim::DriveModel& drive) {
  const mjModel& model = *drive.model;
  const sim::DataPtr data(mj_makeData(&model));
  sim::stand_upright(drive, {}, 0.0, *data);
  mj_kinematics(&model, data.get());
  RobotExtent extent;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (drive.role[static_cast<std::size_t>(geom)] != sim::GeomRole::bump) continue;
    const mjtNum *p = data->geom_xpos + 3 * geom, *R = data->geom_xmat + 9 * geom,
                 *half = model.geom_aabb + 6 * geom + 3;
    const bool upright_round = model.geom_type[geom] == mjGEOM_CYLINDER && std::abs(R[8]) > 0.999;
    const double out_m = std::hypot(p[0], p[1]);
    const double round_m =
        upright_round ? half[0] : mju_norm3(half);  // of a box about any other form
    extent.radius_m = std::max(extent.radius_m, out_m + round_m);
    const double up_m =
        std::abs(R[6]) * half[0] + std::abs(R[7]) * half[1] + std::abs(R[8]) * half[2];
    extent.height_m = std::max(extent.height_m, p[2] + up_m);
  }
  return extent;
}

}  // namespace mapscore::eval

#endif
