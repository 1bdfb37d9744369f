// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

/// Before a function whose loop is to become wide vectors: it is compiled for several widths, of
/// which the processor's is chosen when the program starts. No result depends on the width as long
/// as the loop neither sums over elements nor fuses products. The compiler makes vectors only of
/// loops without branches (-fopt-info-vec says which). Not under ThreadSanitizer: which width runs
/// is chosen before its runtime is there.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12 && \
    !defined(__SANITIZE_THREAD__)
#define MAPSCORE_WIDE_VECTORS [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define MAPSCORE_WIDE_VECTORS
#endif
