// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"

#include "core/geometry/voxel.hpp"

#include <cmath>
#include <numbers>

namespace mapscore {

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose,
                           std::initializer_list<std::uint64_t> indices)
    : state_(mix_bits(seed + 0x9e3779b97f4a7c15ULL)) {
  const auto absorb = [this](std::uint64_t word) {
    state_ = mix_bits(state_ ^ mix_bits(word + 0x9e3779b97f4a7c15ULL)) + 0x9e3779b97f4a7c15ULL;
  };
  for (const char c : purpose) absorb(static_cast<unsigned char>(c));
  absorb(purpose.size());
  for (const std::uint64_t index : indices) absorb(index);
}

std::uint64_t RandomStream::bits() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return mix_bits(state_);
}

double RandomStream::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace mapscore
