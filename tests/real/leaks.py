#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Counts, without truth, points of chairs that lie where no chair can be.

Points of an instance in a frame that are farther than 0.7 m from their median are no part of a chair, 0.9 m of an
armchair. They lie on what is seen past it: leaks. Runs `mapscore segment` on every frame.
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

METHODS = {
    "direct": [],
    "erosion": [],
    "region_growing": ["--radius_factor", "0.5"],  # as map's default
    "largest_component": [],
    "edge_aligned": [],
}
REACH_M = {"chair": 0.7, "armchair": 0.9}


def points(path):
    """N x 3 points in metres of a binary PLY whose vertices begin with float x y z."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    words = [line.split() for line in head.decode().splitlines()]
    count = next(int(w[2]) for w in words if w[:2] == ["element", "vertex"])
    fields = [(w[2], {"float": "<f4", "uint": "<u4"}[w[1]]) for w in words if w[0] == "property"]
    vertices = np.frombuffer(body, np.dtype(fields), count)
    return np.stack([vertices[axis] for axis in "xyz"], axis=1).astype(float)


def segmented(program, recording, frame, method, folder):
    """Of each instance of a frame: class and points."""
    command = [program, "segment", str(recording), "--frame", str(frame), "--method", method, *METHODS[method]]
    subprocess.run([*command, "-o", str(folder)], check=True, stdout=subprocess.DEVNULL)
    with open(folder / "segments.csv", encoding="utf-8") as lines:
        for line in csv.DictReader(lines):
            path = folder / f"instance_{int(line['instance']):05}.ply"
            yield line["class"], points(path) if int(line["points"]) else np.zeros((0, 3))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="example:\n  tests/real/leaks.py build/release/mapscore dining_room")  # fmt: skip
    parser.add_argument("program", help="mapscore")
    parser.add_argument("recording", type=pathlib.Path, help="folder that make_recording.py wrote")
    options = parser.parse_args()
    print(f"{'method':18} {'on chairs':>10} {'leaked':>8} {'share':>7} {'all points':>11} {'empty':>6}")
    try:
        frames = len((options.recording / "depth.txt").read_text().splitlines())
        for method in METHODS:
            kept, leaked, total, empty = 0, 0, 0, 0
            for frame in range(frames):
                with tempfile.TemporaryDirectory() as folder:
                    inside = pathlib.Path(folder) / "segments"
                    for kind, cloud in segmented(options.program, options.recording, frame, method, inside):
                        total, empty = total + len(cloud), empty + (len(cloud) == 0)
                        if kind in REACH_M and len(cloud):
                            away = np.linalg.norm(cloud - np.median(cloud, axis=0), axis=1) > REACH_M[kind]
                            leaked, kept = leaked + int(away.sum()), kept + int((~away).sum())
            share = leaked / max(1, kept + leaked)
            print(f"{method:18} {kept:10} {leaked:8} {100 * share:6.2f}% {total:11} {empty:6}")
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"leaks: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
