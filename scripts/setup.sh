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

# fetch NAME VERSION SHA256 FOLDER UNPACK HINT [OPTION of pip...]: downloads an archive from PyPI, holds it against
# its hash, and unpacks it by `UNPACK ARCHIVE FOLDER`. The folder appears whole or not at all.
fetch() (  # in a shell of its own, for its trap
  name=$1 version=$2 sha256=$3 folder=$4 unpack=$5 hint=$6
  shift 6
  say "fetching $name $version into $folder"
  archives=$(mktemp -d)
  trap 'rm -rf "$archives" "$folder.partial"' EXIT
  if ! python3 -m pip download --quiet --disable-pip-version-check --no-deps "$@" -d "$archives" "$name==$version"; then
    say "$name could not be fetched; $hint"
    exit 2
  fi
  if ! echo "$sha256 $(ls "$archives"/*)" | sha256sum --check --quiet; then
    say "the archive of $name is not the one this project was tested with; nothing was installed"
    exit 2
  fi
  rm -rf "$folder.partial"
  mkdir -p "$folder.partial"
  "$unpack" "$archives"/* "$folder.partial"
  mv "$folder.partial" "$folder"
)

# The wheel carries libmujoco and its headers; nothing of its Python is used.
unpack_mujoco() {
  python3 - "$@" <<'PYTHON'
import sys, zipfile
wheel = zipfile.ZipFile(sys.argv[1])
wanted = [name for name in wheel.namelist()
          if name.startswith(("mujoco/include/", "mujoco/libmujoco.so")) or "LICENSE" in name]
wheel.extractall(sys.argv[2], wanted)
PYTHON
}

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
  fetch mujoco-core "$mujoco_version" "$expected" "$mujoco_folder" unpack_mujoco \
    "or install MuJoCo 3.3 or newer yourself, CMake finds it" --only-binary=:all: \
    --implementation cp --python-version 3.11 --abi cp311 --platform "manylinux_2_28_$machine" \
    --platform "manylinux_2_27_$machine"
}

# The source distribution carries the C++ headers, which is all that is used of it.
unpack_small_gicp() {
  tar -xzf "$1" -C "$2" --strip-components=1 \
    "small_gicp-$small_gicp_version/include" "small_gicp-$small_gicp_version/LICENSE"
}

install_small_gicp() {
  [ -f "$small_gicp_folder/include/small_gicp/registration/registration.hpp" ] && return
  fetch small_gicp "$small_gicp_version" "$small_gicp_sha256" "$small_gicp_folder" unpack_small_gicp \
    "or unpack its headers into $small_gicp_folder/include yourself" --no-binary=small_gicp
}

# GPL-3, so a tool beside the tests and no part of mapscore. Its core needs numpy and scipy alone.
unpack_evo() { python3 -m zipfile -e "$1" "$2"; }

install_evo() {
  [ -f "$evo_folder/evo/core/metrics.py" ] && return
  fetch evo "$evo_version" "$evo_sha256" "$evo_folder" unpack_evo "check the network" --only-binary=:all:
}

install_packages
install_mujoco
install_small_gicp
case "${1:-}" in --ci) install_evo ;; esac
