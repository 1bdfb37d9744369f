// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/look_memory.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {

void LookMemory::add(Looked what, std::vector<VoxelKey> blocks) {
  std::ranges::sort(blocks);
  const auto repeated = std::ranges::unique(blocks);
  blocks.erase(repeated.begin(), repeated.end());
  for (const VoxelKey& block : blocks) ++looks_[static_cast<std::size_t>(what)][block];
}

double LookMemory::worth(Looked what, const VoxelKey& block) const {
  const Looks& looks = looks_[static_cast<std::size_t>(what)];
  const auto found = looks.find(block);
  return found == looks.end() ? 1.0 : std::ldexp(1.0, -found->second);
}

LookMemory::Worths::Worths(const LookMemory& memory, Looked what, const KnownSpace& space) {
  const VoxelKey &low = space.low(), &size = space.size();
  low_ = block_of(low);
  const VoxelKey last = block_of({low.i + size.i - 1, low.j + size.j - 1, low.k + size.k - 1});
  size_ = {last.i - low_.i + 1, last.j - low_.j + 1, last.k - low_.k + 1};
  worths_.assign(static_cast<std::size_t>(size_.i) * static_cast<std::size_t>(size_.j) *
                     static_cast<std::size_t>(size_.k),
                 1.0f);
  for (const auto& [block, count] : memory.looks_[static_cast<std::size_t>(what)]) {
    const VoxelKey at{block.i - low_.i, block.j - low_.j, block.k - low_.k};
    if (at.i < 0 || at.j < 0 || at.k < 0 || at.i >= size_.i || at.j >= size_.j || at.k >= size_.k)
      continue;
    worths_[static_cast<std::size_t>((at.i * size_.j + at.j) * size_.k + at.k)] =
        static_cast<float>(std::ldexp(1.0, -count));
  }
}

}  // namespace mapscore
