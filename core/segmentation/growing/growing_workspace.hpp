// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/growing/lattice_bits.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mapscore {

/// Buffers of region growing, reused by the next call of the same thread: allocating them anew
/// would take longer than growing on a coarse lattice does.
struct GrowingWorkspace {
  using Address = LatticeBits::Address;

  LatticeBits occupied, accepted;
  /// By the address of a cube's low corner: bits of its reached corners while points are marked,
  /// later 1 if these were accepted. All zero between calls.
  std::vector<std::uint8_t> cubes;
  std::vector<Address> cube_of;     ///< each point's cube
  std::vector<Address> marked;      ///< cubes with a reached corner
  std::vector<std::size_t> spread;  ///< points that may reach more than the corners of a cube

  /// Takes this thread's buffers; empty ones when none were given back.
  [[nodiscard]] static GrowingWorkspace take() { return std::exchange(spare(), {}); }

  /// Keeps the buffers for the next call, unless they exceed a few megabytes. Call it only after a
  /// growing that ended without an exception: `marked` must name every cube that is not zero.
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
