#!/bin/sh
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
# Trains the networks of docs/networks.md: records, trains, exports, scores. --help lists the options.
set -eu
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd)
python=${PYTHON:-/usr/bin/python3}
missing=
for pair in torch:python3-torch onnx:python3-onnx cv2:python3-opencv yaml:python3-yaml scipy:python3-scipy; do
  "$python" -c "import ${pair%%:*}" 2>/dev/null || missing="$missing ${pair##*:}"
done
if [ -n "$missing" ]; then
  echo "train.sh: missing; do: apt-get install -y --no-install-recommends$missing" >&2
  exit 2
fi
# Products of 1 x 1 convolutions are too small to share: OpenBLAS then waits in threads that take half the time.
OPENBLAS_NUM_THREADS=1 exec "$python" -W ignore "$here/train.py" "$@"
