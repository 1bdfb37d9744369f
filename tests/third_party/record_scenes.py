#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Records scenes of other people's packages, unedited, and holds their lattice ceilings against a bar.

Run by hand: it downloads some hundred megabytes. Needs numpy and network.

    tests/third_party/record_scenes.py build/release/mapscore /tmp/third_party [NAME ...]
"""

import argparse
import csv
import io
import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass

import numpy as np

sys.dont_write_bytecode = True

from poses import trajectory
from scenes import SCENES, Workshop

FRAMES = 20
LEAST_CEILING = 0.99
SMALL_M = 1.0  # scenes up to this size get small voxels
HERE = os.path.dirname(os.path.abspath(__file__))
HOME = os.path.abspath(os.path.join(HERE, "..", "..", "scenes"))
ROBOT = os.path.join(HOME, "robot.xml")  # its cameras; a package's scene has none beside it, or another robot


@dataclass
class Row:
    name: str
    package: str
    frames: int = 0
    classes: int = 0
    instances: int = 0
    voxel_m: float = 0.0
    truth: int = 0  # visible voxels of the detected classes
    ceiling: float = float("nan")
    note: str = ""

    def holds(self):
        return self.frames == FRAMES and self.truth > 0 and self.ceiling >= LEAST_CEILING


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"exit code {done.returncode}")
    return done.stdout


def voxels(mapscore, scene, edge_m, folder, left_out=lambda name: False):
    """Centres of the truth's voxels in the scene's world, of the classes that are not left out."""
    file = os.path.join(folder, f"surface_{edge_m}.csv")
    run(mapscore, "truth", scene, "--voxel_m", edge_m, "-o", file, "-q")
    with open(file, encoding="utf-8") as text:
        rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    rows = [row for row in rows if row["class"] not in ("background", "0") and not left_out(row["class"])] or rows
    keys = np.array([[int(row[axis]) for axis in "ijk"] for row in rows], dtype=float).reshape(-1, 3)
    if len(keys) == 0:
        raise RuntimeError("no class has a surface")
    return (keys + 0.5) * edge_m


def study(scene, recording, edge_m, folder):
    file = os.path.join(folder, "study.yaml")
    with open(file, "w", encoding="utf-8") as text:
        json.dump({"name": os.path.basename(folder), "recording": recording, "voxel_m": edge_m, "seeds": 1,
                   "methods": {"direct": {"segmentation": {"direct": {}}}}}, text)
    return file


def pooled(table):
    """What the tidy table says of the lattice ceiling, all detected classes together."""
    rows = list(csv.DictReader(io.StringIO(table)))
    values = {}
    for row in rows:
        if "lattice_ceiling" in row.values() and "pooled" in row.values():
            values[row["metric"]] = row["value"]
    return values


def measure(mapscore, workshop, scene):
    row = Row(scene.name, scene.package)
    folder = os.path.join(workshop.folder, "runs", scene.name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    file = workshop.file_of(scene)
    centres = voxels(mapscore, file, 0.05, folder)
    size = np.linalg.norm(centres.max(axis=0) - centres.min(axis=0))
    row.voxel_m = 0.05
    if size < SMALL_M:
        row.voxel_m = 0.02
        centres = voxels(mapscore, file, row.voxel_m, folder)
    poses = os.path.join(folder, "poses.txt")
    with open(poses, "w", encoding="utf-8") as text:
        text.write(trajectory(centres, row.voxel_m, FRAMES))
    recording = os.path.join(folder, "recording")
    run(mapscore, "record", file, "--trajectory", poses, "-o", recording, "-q", "--set", f"robot={ROBOT}",
        *classes_for(mapscore, scene, file, folder))
    row.frames = len(os.listdir(os.path.join(recording, "color")))
    results = os.path.join(folder, "results")
    run(mapscore, "sweep", study(file, recording, row.voxel_m, folder), "-o", results, "-q")
    values = pooled(run(mapscore, "table", results, "--tidy"))
    row.ceiling = float("nan" if values["f1"] == "-" else values["f1"])
    row.truth = int(float(values["visible"]))
    row.classes, row.instances = counts_of(run(mapscore, "info", recording))
    return row


def classes_for(mapscore, scene, file, folder):
    """Flags that name a suggested class file, where it is wanted or the scene is but geoms of the world."""
    if not scene.suggested and counts_of(run(mapscore, "info", file, "--no_picture"))[1] > 0:
        return []
    classes = os.path.join(folder, "suggested.classes.yaml")
    run(mapscore, "info", file, "--suggest_classes", "-o", classes)
    return ["--set", f"classes={classes}"]


def counts_of(info):
    """Classes that have instances, and instances, as `mapscore info` lists them."""
    counts, listed = [], False
    for line in info.splitlines():
        words = line.split() or [""]
        if listed and words[0].isdigit() and words[0] != "0":
            counts.append(int(words[-1]))
        listed = listed and words[0].isdigit() or words[:2] == ["id", "class"]
    return sum(count > 0 for count in counts), sum(counts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mapscore")
    parser.add_argument("folder", help="where packages are kept and runs are written")
    parser.add_argument("names", nargs="*", help="only these scenes")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - {scene.name for scene in SCENES}
    if unknown:
        parser.error(f"no scene {', '.join(sorted(unknown))}; there are {', '.join(s.name for s in SCENES)}")
    workshop = Workshop(arguments.folder, HOME)
    chosen = [scene for scene in SCENES if not arguments.names or scene.name in arguments.names]
    rows = []
    for number, scene in enumerate(chosen, 1):
        started = time.time()
        try:
            rows.append(measure(arguments.mapscore, workshop, scene))
        except (RuntimeError, OSError, ValueError, KeyError, subprocess.CalledProcessError) as error:
            rows.append(Row(scene.name, scene.package, note=str(error).replace("\n", " ")))
        print(f"{number} of {len(chosen)}: {scene.name}, {time.time() - started:.0f} s, "
              f"ceiling {rows[-1].ceiling:.4f} {rows[-1].note}", file=sys.stderr, flush=True)
    print(f"{'scene':<30} {'package':<20} {'frames':>6} {'classes':>7} {'instances':>9} {'voxel_m':>7} "
          f"{'visible':>8} {'ceiling':>8}")
    for row in rows:
        print(f"{row.name:<30} {row.package:<20} {row.frames:>6} {row.classes:>7} {row.instances:>9} "
              f"{row.voxel_m:>7.2f} {row.truth:>8} {row.ceiling:>8.4f} {'' if row.holds() else 'FAILED '}{row.note}")
    failed = sum(not row.holds() for row in rows)
    print(f"{len(rows) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
