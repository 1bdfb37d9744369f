#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# All tests, from a bare machine: installs what is missing, builds, runs. Arguments go to ctest.

set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
mkdir -p build
cmake --preset release >build/configure.log || { cat build/configure.log >&2; exit 1; }
cmake --build --preset release
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "$@"
