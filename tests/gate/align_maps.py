#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""align_maps.py build/release/mapscore STUDY FOLDER [--motions 100] [--random 20] [--first 0]

How often `mapscore score --align` finds a map again. Records the study's scene into FOLDER, maps it with all classes,
moves the map by random rigid motions (up to 3 m, any yaw, up to 10 degrees of tilt) and asks score --align for the way
back: found within 1 cm (of the map's middle) and 0.5 degrees, refused, or wrong. Clouds of random points in the map's
bounds must all be refused. Ends with 1 when fewer than 95 in a hundred are found, one is wrong, or a random cloud is
not refused. A refusal counts as not found. Needs numpy."""
import argparse
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

FIELDS = [("p", "<f4", 3), ("colour", "u1", 3), ("label", "<u4"), ("probability", "<f4")]


def read_ply(file):
    head, body = file.read_bytes().split(b"end_header\n", 1)
    return head + b"end_header\n", np.frombuffer(body, FIELDS).copy()


def rotation(axis, angle):
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def random_motion(rng):
    heading = rng.uniform(0, 2 * np.pi)
    tilt = rotation((np.cos(heading), np.sin(heading), 0), np.radians(rng.uniform(0, 10)))
    shift = rng.normal(size=3)
    return tilt @ rotation((0, 0, 1), rng.uniform(-np.pi, np.pi)), shift / np.linalg.norm(shift) * rng.uniform(0, 3)


def pose_of(numbers):
    x, y, z, w = numbers[3:]
    angle = 2 * np.arctan2(np.linalg.norm([x, y, z]), w)
    axis = np.array([x, y, z]) / max(np.linalg.norm([x, y, z]), 1e-12)
    return rotation(axis, angle), np.array(numbers[:3])


def align(program, cloud, recording):
    """The pose that the program found, or None and what it said."""
    run = subprocess.run([program, "score", cloud, "--align", "--tidy", "--frames", "0",
                          "--truth", recording],
                         capture_output=True, text=True)
    if run.returncode == 0:
        return pose_of([float(word) for word in re.search(r"--transform '([^']*)'", run.stderr)[1].split()]), run.stderr
    if run.returncode != 2:
        sys.exit(f"ended with {run.returncode}: {run.stderr}")
    return None, run.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("study")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--motions", type=int, default=100)
    parser.add_argument("--random", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first motion, to go on from")
    flags = parser.parse_args()
    flags.folder.mkdir(parents=True, exist_ok=True)
    recording, ply = flags.folder / "recording", flags.folder / "map.ply"
    if not recording.exists():
        subprocess.run([flags.program, "record", flags.study, "-o", recording, "-q"], check=True)
    subprocess.run([flags.program, "map", recording, "-o", flags.folder / "map.ot", "--ply", ply, "--detect", "all", "-q"],
                   check=True, stdout=subprocess.DEVNULL)
    head, points = read_ply(ply)
    middle = points["p"].astype(float).mean(axis=0)
    moved = flags.folder / "moved.ply"
    found = refused = 0
    errors = []
    for n in range(flags.first, flags.first + flags.motions):
        R, t = random_motion(np.random.default_rng(n))
        cloud = points.copy()
        cloud["p"] = points["p"].astype(float) @ R.T + t
        moved.write_bytes(head + cloud.tobytes())
        pose, said = align(flags.program, moved, recording)
        if pose is None:
            refused += 1
            print(f"motion {n}: {said.strip()}", flush=True)
            continue
        off_m = np.linalg.norm(pose[0] @ (R @ middle + t) + pose[1] - middle)
        turn_deg = np.degrees(np.arccos(np.clip((np.trace(pose[0] @ R) - 1) / 2, -1, 1)))
        errors.append((off_m, turn_deg))
        found += off_m <= 0.01 and turn_deg <= 0.5
        print(f"motion {n}: {off_m * 1000:.1f} mm, {turn_deg:.3f} deg off", flush=True)
    wrong = flags.motions - found - refused
    random_refused = 0
    for n in range(flags.random):
        rng = np.random.default_rng(1000 + n)
        cloud = points.copy()
        cloud["p"] = rng.uniform(points["p"].min(axis=0), points["p"].max(axis=0), points["p"].shape)
        moved.write_bytes(head + cloud.tobytes())
        random_refused += align(flags.program, moved, recording)[0] is None
    worst = np.array(errors).max(axis=0) if errors else (0, 0)
    print(f"{found} of {flags.motions} found, {refused} refused, {wrong} wrong; at most {worst[0] * 1000:.1f} mm and "
          f"{worst[1]:.3f} deg off; {random_refused} of {flags.random} random clouds refused")
    sys.exit(found < 0.95 * flags.motions or wrong > 0 or random_refused < flags.random)


if __name__ == "__main__":
    main()
