// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/exploration.hpp"
#include "core/exploration/look_memory.hpp"
#include "core/exploration/surroundings.hpp"
#include "core/exploration/view_gain.hpp"

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace mapscore {

/// A place, what it shows all around, and its best heading.
struct Prospect {
  Lookout place;
  double yaw_rad = 0.0;
  Gain all, view;
  double worth = 0.0;             ///< of all around
  std::vector<BlockGain> blocks;  ///< of all around
};

/// What several places show together: of each block what the best of them shows.
class SeenBlocks {
 public:
  /// What a place adds.
  [[nodiscard]] double added_by(const Prospect& prospect) const;
  void add(const Prospect& prospect);

 private:
  std::unordered_map<std::size_t, double> seen_;
};

/// Looks for views that show enough that is new, by what was looked at before. Used by one thread
/// at a time.
class ViewSearch {
 public:
  ViewSearch(const NextBestView& params, const ExploringRobot& robot);

  /// To be called once a decision, first: the robot looks from where it stands.
  void look(const ExplorationState& state, const Surroundings& now);
  /// Places that are reached with a view that is worth at least `least_voxels`; by square.
  [[nodiscard]] std::vector<Prospect> prospects(const ExplorationState& state,
                                                const Surroundings& now) const;
  [[nodiscard]] bool any_prospect(const ExplorationState& state, const Surroundings& now) const;
  /// Where there is no prospect: one more look at what bars the robot from places with a view that
  /// is worth it, since noise may have closed the way; each is looked at once, from the place that
  /// is nearest to it. Then the end.
  void look_once_more(const ExplorationState& state, const Surroundings& now,
                      ExplorationStep& step);

 private:
  [[nodiscard]] ViewGain::Scene scene_of(const ExplorationState& state,
                                         const Surroundings& now) const;
  [[nodiscard]] std::optional<Prospect> prospect(const ViewGain::Scene& scene, const Lookout& place,
                                                 double yaw_rad) const;

  [[nodiscard]] std::vector<double> headings_taken_at(const Lookout& place) const;

  NextBestView params_;
  ViewGain gain_;
  LookMemory memory_;
  std::vector<PlanarPose> views_;          ///< that were taken
  std::vector<Eigen::Vector2d> barred_m_;  ///< places out of reach that were looked towards
  bool looked_ = false, turned_ = false;
};

}  // namespace mapscore
