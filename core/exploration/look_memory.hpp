// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/known_space.hpp"
#include "core/geometry/voxel.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace mapscore {

/// What was looked at.
enum class Looked : std::size_t { unknown, unsure, again };

/// How often the robot looked at a piece of space that a look did not settle: unknown space that a
/// view should have shown, had there been a surface behind which the camera measures (a window, the
/// sky, black paint); a surface whose class stayed uncertain; a point to be looked at again. Each
/// look in vain halves what a further one is worth, so that nothing is looked at for ever. Pieces
/// are blocks of 4 x 4 x 4 cubes.
class LookMemory {
 public:
  [[nodiscard]] static VoxelKey block_of(const VoxelKey& cube) {
    return {cube.i >> 2, cube.j >> 2, cube.k >> 2};
  }

  /// A look at these blocks, each counted once.
  void add(Looked what, std::vector<VoxelKey> blocks);
  /// 2^-looks.
  [[nodiscard]] double worth(Looked what, const VoxelKey& block) const;

  /// worth() of every block of a box, for many reads.
  class Worths {
   public:
    Worths(const LookMemory& memory, Looked what, const KnownSpace& space);
    [[nodiscard]] float of(const VoxelKey& cube) const {
      const VoxelKey block = block_of(cube);
      return worths_[static_cast<std::size_t>(
          ((block.i - low_.i) * size_.j + (block.j - low_.j)) * size_.k + (block.k - low_.k))];
    }

   private:
    VoxelKey low_, size_;  ///< in blocks
    std::vector<float> worths_;
  };

 private:
  using Looks = std::unordered_map<VoxelKey, int>;
  std::array<Looks, 3> looks_;
};

}  // namespace mapscore
