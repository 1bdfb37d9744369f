#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# The main job, from a bare machine: installs what is missing, builds, records the apartment, sweeps
# the demo study and draws its figures into results/demo. A second run computes nothing anew.

set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh
mkdir -p build
cmake --preset release >build/configure.log || { cat build/configure.log >&2; exit 1; }
cmake --build --preset release --target mapscore
build/release/mapscore sweep configs/demo.yaml -o results/demo
build/release/mapscore figures results/demo
build/release/mapscore table results/demo
