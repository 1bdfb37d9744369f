#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds `mapscore score` against the independent ruler, on maps that are made and written here.

foreign_maps.py PROGRAM SCENES    records a drive through corner.xml, writes damaged maps of it in every format, has PROGRAM
    score each, and compares every row of its tidy table: counts exactly, distances within 1e-6 m, all else within 1e-9
"""

import csv
import io
import json
import os
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import numpy as np

sys.dont_write_bytecode = True

import map_scores
from agreement import differences
from distances import KeptDistances
from drives import corner_scene, program, record
from foreign_cases import Bench, point_clouds, voxel_lists
from foreign_trees import label_folders, resampled, trees
from recording import Recording

TRAJECTORY = {"waypoints_m_deg": [[0.213, 0.317, 37], [0.157, 1.013, 11], [0.423, 1.437, 3]], "frames_per_s": 1.1}


def tidy(mapscore, *arguments):
    """(class, metric) -> text."""
    rows = csv.DictReader(io.StringIO(program(mapscore, "score", *arguments, "--tidy", "-q")))
    return {(row["class"], row["metric"]): row["value"] for row in rows}


def details(mapscore, *arguments):
    """What is in the tables of --details and in no tidy one: best thresholds, and counts of free and occupied voxels."""
    result = {}
    for table in json.loads(program(mapscore, "score", *arguments, "--details", "--format", "json", "-q")):
        for row in table["rows"]:
            if "best threshold" in row and row["class"] != "macro":
                result.update({(row["class"], name): "-" if row[name] is None else f"{row[name]:.3f}"
                               for name in ("best threshold", "F1 there")})
            if "truly" in row:
                result.update({("truly " + row["truly"], name): str(row[name]) for name in row if name != "truly"})
    return result


def all_cases(bench):
    for cases in (voxel_lists, point_clouds, trees, resampled, label_folders):
        yield from cases(bench)


def main(mapscore, scenes):
    mapscore, compared, lines = os.path.abspath(mapscore), 0, []
    map_scores.surface_distances = KeptDistances()
    with tempfile.TemporaryDirectory() as folder:
        scene = corner_scene(scenes, folder)
        recording = record(mapscore, scene, TRAJECTORY, folder)
        bench = Bench(Recording(recording), scene, folder)
        for case in all_cases(bench):
            ours = tidy(mapscore, *case.arguments)
            if case.tables:
                ours.update(details(mapscore, *case.arguments))
            theirs = {**case.expected, **case.tables}
            more = differences(case.name, ours, theirs)
            print(f"{case.name}: {len(theirs)} figures, {len(more)} differ", flush=True)
            lines += more
            compared += len(theirs)
    print(f"{compared} figures compared, {len(lines)} differ")
    print("\n".join(lines[:int(os.environ.get("LINES_SHOWN", "60"))]), end="\n" if lines else "")
    return 1 if lines or compared == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
