// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/lattice_bits.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mapscore {

/// Memory of region growing, which each thread keeps for its next call: to ask the system for it
/// anew takes longer than the growing of a coarse lattice.
struct GrowingWorkspace {
  using Address = LatticeBits::Address;

  LatticeBits occupied, accepted;
  std::vector<std::uint8_t> cubes;  ///< by low corner: the corners that are reached; then, whether
                                    ///< they are accepted; all zero between calls
  std::vector<Address> cube_of;     ///< each point's cube
  std::vector<Address> marked;      ///< cubes with a reached corner
  std::vector<std::size_t> spread;  ///< points that may reach more than the corners of a cube

  /// This thread's; it has none until one is given back.
  [[nodiscard]] static GrowingWorkspace take() { return std::exchange(spare(), {}); }

  /// Only whole, after a call that went well, and not when it has grown beyond a few megabytes.
  static void give_back(GrowingWorkspace&& workspace) {
    constexpr std::size_t kMost = 1 << 23;  // of each list
    if (workspace.cubes.size() > kMost || workspace.occupied.addresses() > kMost ||
        workspace.cube_of.size() > kMost / sizeof(Address))
      return;
    for (const Address cube : workspace.marked) workspace.cubes[cube] = 0;
    spare() = std::move(workspace);
  }

 private:
  [[nodiscard]] static GrowingWorkspace& spare() {
    thread_local GrowingWorkspace workspace;
    return workspace;
  }
};

}  // namespace mapscore
