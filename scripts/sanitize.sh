#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# What reads files, under the address and undefined-behaviour sanitizers, from a bare machine: the tests of the rooms
# that read recordings and maps, with more than ten thousand damaged files among them. Arguments go to the test
# programs, such as --gtest_filter='*Damaged*'.

set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
mkdir -p build
# -O1 halves the time that the build takes, which is most of it.
cmake --preset asan -DMAPSCORE_SIMULATOR=OFF -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" >build/configure-asan.log || {
  cat build/configure-asan.log >&2
  exit 1
}
cmake --build --preset asan --target recording_test map_files_test
# A file must not ask for more than this many MB at once.
export ASAN_OPTIONS=max_allocation_size_mb=4096:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
for test in recording_test map_files_test; do
  build/asan/$test --gtest_brief=1 "$@"
done
