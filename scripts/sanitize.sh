#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# The tests of what reads files, or of what runs in threads, under sanitizers, from a bare machine.
#
#   scripts/sanitize.sh             address and undefined behaviour: the rooms that read recordings and maps, with more
#                                   than ten thousand damaged files among their tests
#   scripts/sanitize.sh --threads   data races: replay of all kinds of trials in four jobs, carving among them, the
#                                   writer of recordings, the cache of frames, particle filter, CRF; moving scenes,
#                                   recorded and replayed
#
# Further arguments go to the test programs, such as --gtest_filter='*Damaged*'.

set -euo pipefail
cd "$(dirname "$0")/.."

# build PRESET SIMULATOR PROGRAMS...: SIMULATOR is ON or OFF; -O1 halves the time that the build takes, which is most of it.
build() {
  mkdir -p build
  cmake --preset "$1" -DMAPSCORE_SIMULATOR="$2" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" >"build/configure-$1.log" || {
    cat "build/configure-$1.log" >&2
    exit 1
  }
  cmake --build --preset "$1" --target "${@:3}"
}

scripts/setup.sh
if [ "${1:-}" = --threads ]; then
  shift
  programs=(core_test recording_test lab_test)
  build tsan ON "${programs[@]}"
  export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$PWD/scripts/tsan.supp
  # Mesa's own threads are not built for ThreadSanitizer; without them it draws in the thread that calls it.
  export LP_NUM_THREADS=0
  filter='ParticleFilter.SameBytes*:*CrfFilters*:Writer*:Cache.*:Runner*:MovingRecording.*'
  for program in "${programs[@]}"; do
    build/tsan/$program --gtest_brief=1 --gtest_filter="$filter" "$@"
  done
else
  programs=(files_test recording_test foreign_test map_files_test networks_test)
  build asan OFF "${programs[@]}"
  # A file must not ask for more than this many MB at once.
  export ASAN_OPTIONS=max_allocation_size_mb=4096:detect_stack_use_after_return=1
  export UBSAN_OPTIONS=print_stacktrace=1
  for program in "${programs[@]}"; do
    build/asan/$program --gtest_brief=1 "$@"
  done
fi
