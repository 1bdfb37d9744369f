#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds the program against the independent ruler: the same recordings, the same doses, every count equal.

compare.py PROGRAM SCENES apartment|person    records a small drive, sweeps it with PROGRAM, scores it with ruler.py, and
    compares the truth row by row, every figure of the tidy table and of frames.csv: counts exactly, distances within
    1e-6 m, all else within 1e-9
"""

import csv
import os
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import yaml

sys.dont_write_bytecode = True

import drive_scores
import ruler
from agreement import differences
from distances import KeptDistances, bounds_of
from drives import program, record
from each_frame import compare_frames, swept
from recording import Recording

METHODS = {
    "direct": {"method": "direct"},
    "erosion": {"method": "erosion", "radius_px": 2},
    "growing_half": {"method": "region_growing", "radius_factor": 0.5},
    "growing_one": {"method": "region_growing", "radius_factor": 1},
}
METHODS_AND_PLACES = [f"{name}-{place}" for name in METHODS for place in ("points", "voxels")]
# The lattice ceiling is one for all methods; two at dose zero stand for all.
CEILINGS_OF = {"lattice_ceiling": ["direct-points"], "registration_ceiling": ["direct-points", "growing_half-voxels"]}
OF_OTHER_SEEDS = ("f1_best", "threshold_best")  # undefined with one seed

# A drive, its lattice, and the ways in which it is scored. Doses are without a round number on purpose. The person has
# voxels of the default size; the apartment, whose surfaces are many times as large, has larger ones: each of its 350
# geoms keeps some surface in them, and more pairs of geoms meet than in finer ones.
STUDIES = {
    "apartment": {
        "scene": "apartment.xml", "voxel_m": 0.09, "origin_m": (0.0131, 0.0217, 0.0343), "yaw_deg": 0,
        "trajectory": {"waypoints_m_deg": [[2.763, 4.813, -137], [1.413, 4.737, -38], [1.027, 2.963, -8],
                                            [1.143, 1.553, 22], [2.637, 1.647, -58]], "frames_per_s": 0.37},
        "misregistration_m": (0.0173, -0.0061, 0.0029), "rotation_deg": (0.31, -0.17, 0.53),
        "runs": [("map", 0.5)]},
    "person": {
        "scene": "person.xml", "voxel_m": 0.05, "origin_m": (-0.0233, 0.0107, 0.0071), "yaw_deg": 7.3,
        "trajectory": {"waypoints_m_deg": [[-1.963, 0.613, -17], [-2.427, 0.317, -8], [-2.573, -0.113, 2],
                                            [-2.317, -0.497, 11]], "frames_per_s": 1.1},
        "misregistration_m": (-0.0211, 0.0043, 0.0017), "rotation_deg": (-0.23, 0.47, 0.19),
        "runs": [("frame", 0.5), ("map", 0.6)]},
}


def study_file(study, recording, unit, K, methods, folder):
    """A study file with methods, each placed as its name says."""
    segmentations = {
        name: {of["method"]: {key: value for key, value in of.items() if key != "method"}}
        for name, of in METHODS.items()}
    file = os.path.join(folder, f"{unit}-{K}-{len(methods)}.yaml")
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump({
            "recording": recording, "voxel_m": study["voxel_m"],
            "map_origin_m": list(study["origin_m"]), "map_yaw_deg": study["yaw_deg"],
            "methods": {method: {"segmentation": segmentations[method.split("-")[0]], "place": method.split("-")[1]}
                        for method in methods},
            "fusion": {"blend": {"K": K}}, "score": {"unit": unit},
            "faults": {"misregistration": {"translation_m": list(study["misregistration_m"]),
                                           "rotation_deg": list(study["rotation_deg"])}}}, text)
    return file


def lattice_flags(study):
    return {"voxel_m": (study["voxel_m"],), "origin_m": study["origin_m"], "yaw_deg": (study["yaw_deg"],)}


def words(flags):
    return [word for key, values in flags.items() for word in (f"--{key}", *map(str, values))]


def ruler_options(study, recording, role, method, unit, K):
    name, place = method.split("-")
    flags = {**lattice_flags(study), "unit": (unit,), "K": (K,)}
    if role == "trial":
        flags.update(misregistration_m=study["misregistration_m"], rotation_deg=study["rotation_deg"])
    if role == "lattice_ceiling":
        flags.update(labels=("depth_label",))
    else:
        flags.update(place=(place,), **{key: (value,) for key, value in METHODS[name].items()})
    return ruler.parse([recording, *words(flags)])[1]


def compare_scores(mapscore, study, recording, folder):
    lines, compared = [], 0
    loaded = Recording(recording)
    for unit, K in study["runs"]:
        file = study_file(study, recording, unit, K, METHODS_AND_PLACES, folder)
        figures = swept(mapscore, file, os.path.join(folder, f"{unit}-{K}"))
        for role, method in sorted({key[:2] for key in figures}):
            if method not in CEILINGS_OF.get(role, METHODS_AND_PLACES):
                continue
            ours = {key[2:]: text for key, text in figures.items() if key[:2] == (role, method) and key[2] != "all"}
            theirs = ruler.score(loaded, ruler_options(study, recording, role, method, unit, K))
            theirs.update({key: None for key in ours if key[1] in OF_OTHER_SEEDS})
            lines += differences(f"{unit}, K = {K}: {role} {method}", ours, theirs)
            compared += len(theirs)
    return lines, compared


def compare_each_frame(mapscore, study, recording, folder):
    method, K = "direct-points", 0.5
    options = ruler_options(study, recording, "trial", method, "frame", K)
    file = study_file(study, recording, "frame", K, [method], folder)
    return compare_frames(mapscore, file, method, Recording(recording), options, os.path.join(folder, "each_frame"))


def compare_truth(mapscore, study, recording, folder):
    """Rows of the truth, i, j, k, class, touch_only, samples, in any order."""
    file = os.path.join(folder, "truth.csv")
    lattice = words(lattice_flags(study))
    program(mapscore, "truth", recording, *lattice, "-o", file)
    with open(file, encoding="utf-8", newline="") as text:
        ours = {tuple(row) for row in csv.reader(text)}
    rows = ruler.truth_rows(Recording(recording), ruler.parse(["truth", recording, *lattice])[1])
    theirs = {tuple(map(str, row)) for row in rows}
    lines = [f"  truth: only the program has {','.join(row)}" for row in sorted(ours - theirs)]
    lines += [f"  truth: only the ruler has {','.join(row)}" for row in sorted(theirs - ours)]
    return lines, len(theirs)


def keep_what_scores_share():
    """The ruler's surface truth of a lattice and its distances, made once, since all scores of a drive share them."""
    surface_truth, truths = ruler.surface_truth, {}

    def kept_truth(geoms, voxel, epsilon):
        key = bounds_of([shape for _, shape in geoms]), voxel, epsilon
        if key not in truths:
            truths[key] = surface_truth(geoms, voxel, epsilon)
        return truths[key]

    ruler.surface_truth, drive_scores.surface_distances = kept_truth, KeptDistances()


COMPARISONS = {"rows of truth": compare_truth, "figures": compare_scores, "figures of frames": compare_each_frame}


def main(mapscore, scenes, drive):
    keep_what_scores_share()
    study, failed = STUDIES[drive], False
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(os.path.abspath(scenes), study["scene"])
        recording = record(os.path.abspath(mapscore), scene, study["trajectory"], folder)
        for what, compare in COMPARISONS.items():
            lines, compared = compare(os.path.abspath(mapscore), study, recording, folder)
            print(f"{drive}: {compared} {what} compared, {len(lines)} differ")
            print("\n".join(lines[:40]), end="\n" if lines else "")
            failed |= bool(lines) or compared == 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
