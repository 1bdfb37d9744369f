#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# Installs what mapscore stands on: Debian packages that are missing, and the pinned releases of MuJoCo and
# small_gicp, which are unpacked below build/deps. Does nothing when all is there. Needs root only to install
# packages.
#
#   scripts/setup.sh           what building, the demo and the tests need
#   scripts/setup.sh --train   and what trains networks
#   scripts/setup.sh --ci      and that, clang-format for the format check, and evo, against which ATE and RPE are held

set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  g++ cmake ninja-build ccache
  libeigen3-dev libopencv-dev liboctomap-dev libnanoflann-dev libyaml-cpp-dev libcli11-dev
  libfmt-dev libsqlite3-dev nlohmann-json3-dev libsimdjson-dev libxxhash-dev libdeflate-dev liblzf-dev
  libosmesa6-dev libboost-dev libceres-dev libgtest-dev libgmock-dev libbenchmark-dev
  gnuplot-nox fonts-dejavu-core
  python3 python3-pip python3-numpy python3-scipy python3-yaml python3-pil sqlite3
)
case "${1:-}" in --train | --ci) packages+=(python3-torch python3-onnx python3-opencv) ;; esac
case "${1:-}" in --ci) packages+=(clang-format) ;; esac

mujoco_version=4.0.1
mujoco_folder=build/deps/mujoco-$mujoco_version
declare -A mujoco_sha256=(
  [x86_64]=be28c0c7587347ef996b4de0487264e9da296282082b092bae211a9163e9aed6
  [aarch64]=52d934614a56f7d75dcfc2bd8bb72f058b465ecc19a0583a56df242f9505bdb6
)
small_gicp_version=1.0.1
small_gicp_folder=build/deps/small_gicp-$small_gicp_version
small_gicp_sha256=e0b1a03a87da154b53b489cce7079b5be02ba17723f89c4161f8311b564ca0b1

evo_version=1.38.1
evo_folder=build/deps/evo-$evo_version
evo_sha256=6f9ebbedec38de74c481a62b04d24c2320568878a9a8cf92cc3f627ef515ac9e

say() { printf 'setup: %s\n' "$*" >&2; }

missing_packages() {
  local installed
  installed=$({ dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true; } |
    awk '$2 == "installed" {print $1}' | sort -u)
  comm -23 <(printf '%s\n' "${packages[@]}" | sort -u) <(printf '%s\n' "$installed")
}

install_packages() {
  command -v dpkg-query >/dev/null || {
    say "this script knows Debian's packages only; on another system install: ${packages[*]}"
    exit 2
  }
  local missing
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -eq 0 ] && return
  if [ "$(id -u)" -ne 0 ]; then
    say "missing Debian packages: ${missing[*]}"
    say "install them as root: apt-get install --no-install-recommends ${missing[*]}"
    exit 2
  fi
  say "installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { apt-get update && DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 5 "$log" >&2
    say "apt-get failed; its whole output is in $log"
    exit 2
  fi
  rm -f "$log"
}

# The wheel carries libmujoco and its headers; nothing of its Python is used.
install_mujoco() {
  [ -f "$mujoco_folder/mujoco/include/mujoco/mujoco.h" ] && return
  for prefix in /usr/local /usr; do
    if [ -f "$prefix/include/mujoco/mujoco.h" ]; then
      say "taking the system's own MuJoCo in $prefix; this project was tested with $mujoco_version"
      return
    fi
  done
  local machine expected
  machine=$(uname -m)
  expected=${mujoco_sha256[$machine]:-}
  if [ -z "$expected" ]; then
    say "no MuJoCo wheel is known for $machine; install MuJoCo 3.3 or newer yourself, CMake finds it"
    exit 2
  fi
  say "fetching MuJoCo $mujoco_version into $mujoco_folder"
  wheel_folder=$(mktemp -d)
  trap 'rm -rf "$wheel_folder" "$mujoco_folder.partial"' EXIT
  if ! python3 -m pip download --quiet --disable-pip-version-check --no-deps --only-binary=:all: \
    --implementation cp --python-version 3.11 --abi cp311 --platform "manylinux_2_28_$machine" \
    --platform "manylinux_2_27_$machine" -d "$wheel_folder" "mujoco-core==$mujoco_version"; then
    say "MuJoCo could not be fetched; or install MuJoCo 3.3 or newer yourself, CMake finds it"
    exit 2
  fi
  if ! echo "$expected $(ls "$wheel_folder"/*.whl)" | sha256sum --check --quiet; then
    say "the MuJoCo wheel is not the one this project was tested with; nothing was installed"
    exit 2
  fi
  rm -rf "$mujoco_folder.partial"
  mkdir -p "$mujoco_folder.partial"
  python3 - "$wheel_folder" "$mujoco_folder.partial" <<'PYTHON'
import glob, sys, zipfile
wheel = zipfile.ZipFile(glob.glob(sys.argv[1] + "/*.whl")[0])
wanted = [name for name in wheel.namelist()
          if name.startswith(("mujoco/include/", "mujoco/libmujoco.so")) or "LICENSE" in name]
wheel.extractall(sys.argv[2], wanted)
PYTHON
  mv "$mujoco_folder.partial" "$mujoco_folder"
}

# The source distribution carries the C++ headers, which is all that is used of it.
install_small_gicp() (  # in a shell of its own, for its trap
  [ -f "$small_gicp_folder/include/small_gicp/registration/registration.hpp" ] && exit
  say "fetching small_gicp $small_gicp_version into $small_gicp_folder"
  sdist_folder=$(mktemp -d)
  trap 'rm -rf "$sdist_folder" "$small_gicp_folder.partial"' EXIT
  if ! python3 -m pip download --quiet --disable-pip-version-check --no-deps --no-binary=small_gicp \
    -d "$sdist_folder" "small_gicp==$small_gicp_version"; then
    say "small_gicp could not be fetched; or unpack its headers into $small_gicp_folder/include yourself"
    exit 2
  fi
  if ! echo "$small_gicp_sha256 $(ls "$sdist_folder"/small_gicp-*.tar.gz)" | sha256sum --check --quiet; then
    say "the small_gicp archive is not the one this project was tested with; nothing was installed"
    exit 2
  fi
  rm -rf "$small_gicp_folder.partial"
  mkdir -p "$small_gicp_folder.partial"
  tar -xzf "$sdist_folder"/small_gicp-*.tar.gz -C "$small_gicp_folder.partial" --strip-components=1 \
    "small_gicp-$small_gicp_version/include" "small_gicp-$small_gicp_version/LICENSE"
  mv "$small_gicp_folder.partial" "$small_gicp_folder"
)

# GPL-3, so a tool beside the tests and no part of mapscore. Its core needs numpy and scipy alone.
install_evo() (  # in a shell of its own, for its trap
  [ -f "$evo_folder/evo/core/metrics.py" ] && exit
  say "fetching evo $evo_version into $evo_folder"
  wheel_folder=$(mktemp -d)
  trap 'rm -rf "$wheel_folder" "$evo_folder.partial"' EXIT
  if ! python3 -m pip download --quiet --disable-pip-version-check --no-deps --only-binary=:all: \
    -d "$wheel_folder" "evo==$evo_version"; then
    say "evo could not be fetched; check the network"
    exit 2
  fi
  if ! echo "$evo_sha256 $(ls "$wheel_folder"/*.whl)" | sha256sum --check --quiet; then
    say "the evo wheel is not the one this project was tested with; nothing was installed"
    exit 2
  fi
  rm -rf "$evo_folder.partial"
  mkdir -p "$evo_folder.partial"
  python3 -m zipfile -e "$wheel_folder"/*.whl "$evo_folder.partial"
  mv "$evo_folder.partial" "$evo_folder"
)

install_packages
install_mujoco
install_small_gicp
case "${1:-}" in --ci) install_evo ;; esac
