#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Trains the networks of docs/networks.md: records, trains, exports, scores; --help lists the options. From a bare
# machine: installs what is missing and builds mapscore, unless --program names one.

set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

# As scripts/demo.sh does.
build_mapscore() {
  cd "$here/../.."
  scripts/setup.sh --train
  mkdir -p build
  cmake --preset release >build/configure.log || { cat build/configure.log >&2; exit 1; }
  cmake --build --preset release --target mapscore >build/mapscore.log || { cat build/mapscore.log >&2; exit 1; }
}

case " $* " in
  *" --help "* | *" -h "* | *" --program"*) ;;
  *) (build_mapscore) ;;
esac

python=${PYTHON:-/usr/bin/python3}
missing=
for pair in torch:python3-torch onnx:python3-onnx cv2:python3-opencv yaml:python3-yaml scipy:python3-scipy; do
  "$python" -c "import ${pair%%:*}" 2>/dev/null || missing="$missing ${pair##*:}"
done
if [ -n "$missing" ]; then
  echo "train.sh: $python lacks modules; do: apt-get install -y --no-install-recommends$missing" >&2
  exit 2
fi
# Products of 1 x 1 convolutions are too small to share: OpenBLAS then waits in threads that take half the time.
OPENBLAS_NUM_THREADS=1 exec "$python" -W ignore "$here/train.py" "$@"
