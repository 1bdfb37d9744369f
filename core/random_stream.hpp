// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace mapscore {

/// A stream of random numbers that is named, not shared: (seed, purpose, indices...) fixes every
/// draw, so a result depends on neither the order of the trials nor threads nor shards. SplitMix64
/// and Box-Muller, written out because the distributions of the standard library differ between
/// vendors. Not thread-safe; make one where it is used.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose,
               std::initializer_list<std::uint64_t> indices = {});

  [[nodiscard]] std::uint64_t bits();
  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  /// Passes over so many draws of bits() or uniform(), at the cost of one.
  void skip(std::uint64_t draws) { state_ += draws * 0x9e3779b97f4a7c15ULL; }
  /// Standard normal.
  [[nodiscard]] double normal();

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace mapscore
