#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# The README's table of tolerances, of two homes, as Markdown on stdout; figures and trials go into
# results/tolerance and results/tolerance_cottage. Needs build/release/mapscore (scripts/demo.sh
# builds it). A second run computes nothing anew.

set -euo pipefail
cd "$(dirname "$0")/.."

for study in tolerance tolerance_cottage; do
  build/release/mapscore tolerance "configs/$study.yaml" --figure "results/$study/figures" \
    --format markdown
done
