// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/placement.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"
#include "core/mapping/cell_placement.hpp"
#include "core/mapping/hit_grid.hpp"
#include "core/mapping/position_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

namespace mapscore {
namespace {

/// Positions of one class in one voxel; `voxel` is a packed key.
struct Tally {
  std::uint64_t voxel;
  ClassId class_id;
  int count;
  double best_score;
};

/// A class that won a voxel in one draw.
struct Win {
  std::uint64_t voxel;
  ClassId class_id;
  double score;
};

/// Neighbouring positions mostly share a voxel, so runs are counted before anything is sorted.
void tally_object(const ObservedObject& object, const Pose& T_map_sensor, double edge_m,
                  std::vector<Tally>& tallies) {
  const Eigen::Matrix3d R = T_map_sensor.linear();
  const Eigen::Vector3d t = T_map_sensor.translation();
  const std::size_t first = tallies.size();
  for (const Eigen::Vector3d& p_sensor : object.positions) {
    const Eigen::Vector3d p_map = R * p_sensor + t;
    const std::optional<VoxelKey> key = packable_voxel_of(p_map, edge_m);
    if (!key) continue;
    const std::uint64_t voxel = pack(*key);
    if (tallies.size() > first && tallies.back().voxel == voxel)
      ++tallies.back().count;
    else
      tallies.push_back({voxel, object.class_id, 1, object.score});
  }
}

/// Adds up the tallies of each voxel and keeps its winner.
void append_winners(std::vector<Tally>& tallies, std::vector<Win>& wins) {
  std::sort(tallies.begin(), tallies.end(), [](const Tally& a, const Tally& b) {
    return std::tie(a.voxel, a.class_id) < std::tie(b.voxel, b.class_id);
  });
  for (auto tally = tallies.begin(); tally != tallies.end();) {
    Tally winner{tally->voxel, kBackground, 0, 0.0};
    while (tally != tallies.end() && tally->voxel == winner.voxel) {
      Tally total{tally->voxel, tally->class_id, 0, 0.0};
      for (; tally != tallies.end() && tally->voxel == total.voxel &&
             tally->class_id == total.class_id;
           ++tally) {
        total.count += tally->count;
        total.best_score = std::max(total.best_score, tally->best_score);
      }
      if (total.count > winner.count) winner = total;
    }
    wins.push_back({winner.voxel, winner.class_id, winner.best_score});
  }
}

/// Collects the wins of all draws into one hit per voxel and class.
std::vector<VoxelHit> collect(std::vector<Win>& wins, bool one_draw) {
  if (!one_draw)
    std::stable_sort(wins.begin(), wins.end(), [](const Win& a, const Win& b) {
      return std::tie(a.voxel, a.class_id) < std::tie(b.voxel, b.class_id);
    });
  std::vector<VoxelHit> hits;
  hits.reserve(wins.size());
  for (auto win = wins.begin(); win != wins.end();) {
    VoxelHit hit{unpack(win->voxel), win->class_id, 0, 0.0};
    const Win& first = *win;
    for (; win != wins.end() && win->voxel == first.voxel && win->class_id == first.class_id;
         ++win) {
      ++hit.draws;
      hit.score_sum += win->score;
    }
    hits.push_back(hit);
  }
  return hits;
}

std::vector<VoxelHit> place_positions(const Observation& observation,
                                      std::span<const Pose> T_map_sensor, double edge_m) {
  std::vector<Win> wins;
  std::vector<Tally> tallies;
  for (const Pose& pose : T_map_sensor) {
    tallies.clear();
    for (const ObservedObject& object : observation) tally_object(object, pose, edge_m, tallies);
    append_winners(tallies, wins);
  }
  return collect(wins, T_map_sensor.size() == 1);
}

/// The draw whose rotation is nearest to the mean of all: the others turn least against it.
const Pose& central(std::span<const Pose> T_map_sensor) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Pose& pose : T_map_sensor) sum += pose.linear();
  const Eigen::Matrix3d mean = sum / static_cast<double>(T_map_sensor.size());
  return *std::min_element(
      T_map_sensor.begin(), T_map_sensor.end(), [&](const Pose& a, const Pose& b) {
        return (a.linear() - mean).squaredNorm() < (b.linear() - mean).squaredNorm();
      });
}

/// The same by whole cells; empty where observation or draws do not suit.
std::optional<std::vector<VoxelHit>> place_by_cells(const Observation& observation,
                                                    std::span<const Pose> T_map_sensor,
                                                    double edge_m) {
  const auto cells = PositionCells::sort(observation, central(T_map_sensor), edge_m);
  if (!cells) return {};
  const auto box = reach_of(*cells, T_map_sensor, edge_m);
  if (!box) return {};
  HitGrid grid(*box, cells->groups());
  CellPlacer placer(*cells, edge_m, grid);
  for (std::size_t n = 0; n < T_map_sensor.size(); n += DrawSet::kMost)
    placer.place(T_map_sensor.subspan(n, std::min(DrawSet::kMost, T_map_sensor.size() - n)));
  return grid.hits();
}

}  // namespace

std::vector<VoxelHit> place(const Observation& observation, std::span<const Pose> T_map_sensor,
                            double edge_m) {
  constexpr std::size_t kWorthCells = 4;  // draws from which sorting into cells pays
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (T_map_sensor.size() >= kWorthCells)
    if (auto hits = place_by_cells(observation, T_map_sensor, edge_m)) return std::move(*hits);
  return place_positions(observation, T_map_sensor, edge_m);
}

}  // namespace mapscore
