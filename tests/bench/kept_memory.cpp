// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include <malloc.h>

namespace {

/// Benchmarks keep the memory that they free, as `mapscore` does (eval/cli/main.cpp): otherwise
/// pages of a frame's images are given back and fetched again each time, which is what they would
/// time.
[[maybe_unused]] const bool kKept = [] {
  return mallopt(M_MMAP_THRESHOLD, 32 << 20) != 0 && mallopt(M_TRIM_THRESHOLD, 128 << 20) != 0;
}();

}  // namespace
