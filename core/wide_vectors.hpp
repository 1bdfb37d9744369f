// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

/// Before a function whose loop is to become wide vectors: it is compiled for several widths, of
/// which the processor's is chosen when the program starts. No result depends on the width as long
/// as the loop neither sums over elements nor fuses products. The compiler makes vectors only of
/// loops without branches (-fopt-info-vec says which), with few arrays that may overlap;
/// tests/core/wide_loops.py finds functions in which it made none. Not under ThreadSanitizer: which
/// width runs is chosen before its runtime is there.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && \
    !defined(__SANITIZE_THREAD__)
#define MAPSCORE_WIDE_VECTORS [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define MAPSCORE_WIDE_VECTORS
#endif

/// Before a loop over arrays of which none that it writes overlaps another: the compiler gives up
/// on more than ten pairs that it would have to check.
#if defined(__GNUC__) && !defined(__clang__)
#define MAPSCORE_NO_OVERLAPS _Pragma("GCC ivdep")
#else
#define MAPSCORE_NO_OVERLAPS
#endif

namespace mapscore {

/// The pixels of a row that a wide loop has marked with 1, the others with 0.
using Marks = std::vector<std::uint8_t>;

/// Calls use(n) with each of `count` places n that is marked with 1, in order; quick where few are.
void for_each_marked(const std::uint8_t* marks, int count, auto&& use) {
  const std::uint8_t* const end = marks + count;
  for (const std::uint8_t* from = marks; from != end; ++from) {
    from = static_cast<const std::uint8_t*>(
        std::memchr(from, 1, static_cast<std::size_t>(end - from)));
    if (from == nullptr) return;
    use(static_cast<int>(from - marks));
  }
}

void for_each_marked(const Marks& marks, auto&& use) {
  for_each_marked(marks.data(), static_cast<int>(marks.size()), use);
}

}  // namespace mapscore
