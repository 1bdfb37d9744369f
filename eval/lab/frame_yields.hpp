// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/bench.hpp"
#include "eval/study/grid.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Voxels of a class that a frame maps by itself (`score.unit: frame`).
struct FrameYield {
  std::int64_t found = 0;   ///< of those that it sees
  std::int64_t falses = 0;  ///< predicted and not of the class

  bool operator==(const FrameYield&) const = default;
};

/// What each frame of a recording gives to one trial.
struct TrialYields {
  std::string method;
  Cell cell;
  std::vector<std::map<std::string, FrameYield>> frames;  ///< by class name; none where both are 0
};

/// The yields of these trials of a study. Walks the recording once for each cell, on one thread.
/// Throws Error as TrialRun.
[[nodiscard]] std::vector<TrialYields> yields_of(const Study& study,
                                                 const std::vector<TrialSpec>& specs, Bench& bench);

/// A frame that gives less than before.
struct FrameLoss {
  int frame = 0;  ///< index in the recording
  FrameYield before, after;

  /// Voxels that it finds no more, and those that became false.
  [[nodiscard]] std::int64_t voxels() const {
    return before.found - after.found + after.falses - before.falses;
  }
};

/// The frames that lose voxels of these classes together, most first.
[[nodiscard]] std::vector<FrameLoss> frame_losses(const TrialYields& before,
                                                  const TrialYields& after,
                                                  const std::vector<std::string>& classes);

}  // namespace mapscore::eval
