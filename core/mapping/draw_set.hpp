// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace mapscore {

/// Number of set bits; spelt out, since the default build has no instruction for it.
[[nodiscard]] inline std::uint32_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555ULL;
  bits = (bits & 0x3333333333333333ULL) + (bits >> 2 & 0x3333333333333333ULL);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<std::uint32_t>(bits * 0x0101010101010101ULL >> 56);
}

/// A set of the draws of one batch, a bit each.
struct DrawSet {
  static constexpr std::size_t kMost = 128;  ///< draws a batch

  std::array<std::uint64_t, 2> words{};

  [[nodiscard]] static DrawSet of(std::size_t draw) {
    DrawSet set;
    set.words[draw / 64] = std::uint64_t{1} << draw % 64;
    return set;
  }
  [[nodiscard]] bool any() const { return (words[0] | words[1]) != 0; }
  [[nodiscard]] bool has(std::size_t draw) const {
    return (words[draw / 64] >> draw % 64 & 1) != 0;
  }
  [[nodiscard]] std::uint32_t count() const { return count_bits(words[0]) + count_bits(words[1]); }

  DrawSet& operator|=(const DrawSet& other) { return *this = *this | other; }
  DrawSet& operator&=(const DrawSet& other) { return *this = *this & other; }
  friend DrawSet operator|(const DrawSet& a, const DrawSet& b) {
    return {{a.words[0] | b.words[0], a.words[1] | b.words[1]}};
  }
  friend DrawSet operator&(const DrawSet& a, const DrawSet& b) {
    return {{a.words[0] & b.words[0], a.words[1] & b.words[1]}};
  }
  friend DrawSet operator~(const DrawSet& a) { return {{~a.words[0], ~a.words[1]}}; }
};

/// Calls act(draw) for the draws of a set, ascending.
void for_each_draw(const DrawSet& set, auto&& act) {
  for (std::size_t word = 0; word < 2; ++word)
    for (std::uint64_t left = set.words[word]; left != 0; left &= left - 1)
      act(64 * word + static_cast<std::size_t>(std::countr_zero(left)));
}

/// A level, 0 to 255, for each draw of a batch.
struct alignas(16) DrawLevels {
  std::array<std::uint8_t, DrawSet::kMost> of;
};

/// Draws whose level is at least `least`.
[[nodiscard]] inline DrawSet at_least(const DrawLevels& levels, unsigned least) {
  DrawSet set;
  if (least > 255) return set;
#ifdef __SSE2__
  const __m128i bound = _mm_set1_epi8(static_cast<char>(least));
  for (std::size_t n = 0; n < DrawSet::kMost; n += 16) {
    const __m128i some = _mm_load_si128(reinterpret_cast<const __m128i*>(&levels.of[n]));
    const int reached = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(some, bound), some));
    set.words[n / 64] |= std::uint64_t{static_cast<unsigned>(reached)} << n % 64;
  }
#else
  for (std::size_t n = 0; n < DrawSet::kMost; ++n)
    set.words[n / 64] |= std::uint64_t{levels.of[n] >= least} << n % 64;
#endif
  return set;
}

}  // namespace mapscore
