#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds the program against the independent ruler: the same recordings, the same doses, every count equal.

compare.py PROGRAM SCENES apartment|person    records a small drive, sweeps it with PROGRAM, scores it with ruler.py, and
    compares counts exactly, mean distances within 1e-6 m, and the truth row by row
"""

import csv
import io
import os
import subprocess
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import numpy as np
import yaml

sys.dont_write_bytecode = True

import ruler
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
COUNTS = ("predicted", "true_predicted", "visible", "found", "false_near", "false_leak", "false_floating",
          "missed_mislabelled", "missed_unlabelled", "missed_unmapped", "true_predicted_t1", "found_t1")
MEANS = ("accuracy_mean_m", "completeness_mean_m")
CAMERAS = {"width_px": 160, "height_px": 120}

# A drive, its lattice, and the ways in which it is scored. Doses are without a round number on purpose.
STUDIES = {
    "apartment": {
        "scene": "apartment.xml", "origin_m": (0.0131, 0.0217, 0.0343), "yaw_deg": 0,
        "trajectory": {"waypoints_m_deg": [[2.763, 4.813, -137], [1.413, 4.737, -38], [1.027, 2.963, -8],
                                            [1.143, 1.553, 22], [2.637, 1.647, -58]], "frames_per_s": 0.37},
        "misregistration_m": (0.0173, -0.0061, 0.0029), "rotation_deg": (0.31, -0.17, 0.53),
        "runs": [("map", 0.5)]},
    "person": {
        "scene": "person.xml", "origin_m": (-0.0233, 0.0107, 0.0071), "yaw_deg": 7.3,
        "trajectory": {"waypoints_m_deg": [[-1.963, 0.613, -17], [-2.427, 0.317, -8], [-2.573, -0.113, 2],
                                            [-2.317, -0.497, 11]], "frames_per_s": 1.1},
        "misregistration_m": (-0.0211, 0.0043, 0.0017), "rotation_deg": (-0.23, 0.47, 0.19),
        "runs": [("frame", 0.5), ("map", 0.6)]},
}


def program(*arguments):
    return subprocess.run(arguments, check=True, stdout=subprocess.PIPE, text=True).stdout


def study_text(study, recording, unit, K):
    """A study file with every method placed both ways."""
    segmentations = {
        name: {of["method"]: {key: value for key, value in of.items() if key != "method"}}
        for name, of in METHODS.items()}
    return yaml.safe_dump({
        "recording": recording, "map_origin_m": list(study["origin_m"]), "map_yaw_deg": study["yaw_deg"],
        "methods": {method: {"segmentation": segmentations[method.split("-")[0]], "place": method.split("-")[1]}
                    for method in METHODS_AND_PLACES},
        "fusion": {"blend": {"K": K}}, "score": {"unit": unit},
        "faults": {"misregistration": {"translation_m": list(study["misregistration_m"]),
                                       "rotation_deg": list(study["rotation_deg"])}}})


def record(mapscore, scenes, study, folder):
    file, recording = os.path.join(folder, "drive.yaml"), os.path.join(folder, "recording")
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump({"scene": os.path.join(scenes, study["scene"]), "trajectory": study["trajectory"],
                   "cameras": CAMERAS, "methods": {"direct": {"segmentation": {"direct": {}}}}}, text)
    program(mapscore, "record", file, "-o", recording, "-q")
    return recording


def swept(mapscore, study, recording, unit, K, folder):
    """(role, method, class, metric) -> value, as the program tells it."""
    results = os.path.join(folder, f"{unit}-{K}")
    file = results + ".yaml"
    with open(file, "w", encoding="utf-8") as text:
        text.write(study_text(study, recording, unit, K))
    program(mapscore, "sweep", file, "-o", results, "-q")
    rows = csv.DictReader(io.StringIO(program(mapscore, "table", results, "--tidy")))
    return {(row["role"], row["method"], row["class"], row["metric"]): row["value"] for row in rows}


def ruler_options(study, recording, role, method, unit, K):
    name, place = method.split("-")
    flags = {"origin_m": study["origin_m"], "yaw_deg": (study["yaw_deg"],), "unit": (unit,), "K": (K,)}
    if role == "trial":
        flags.update(misregistration_m=study["misregistration_m"], rotation_deg=study["rotation_deg"])
    if role == "lattice_ceiling":
        flags.update(labels=("depth_label",))
    else:
        flags.update(place=(place,), **{key: (value,) for key, value in METHODS[name].items()})
    arguments = [recording]
    for key, values in flags.items():
        arguments += [f"--{key}", *map(str, values)]
    return ruler.parse(arguments)[1]


def distances_agree(ours, theirs, class_name, metric):
    """The ruler counts what lies within tau; the program tells its share, in nine digits."""
    kind, tau = metric.rsplit("_", 1)
    whole = theirs[class_name, "predicted" if kind == "precise" else "samples"]
    part = theirs[class_name, metric]
    share = ours(f"{'precision' if kind == 'precise' else 'recall'}_{tau}")
    return share == "-" if int(whole) == 0 else round(float(share) * int(whole)) == int(part)


def means_agree(ours, theirs):
    return ours == theirs if "-" in (ours, theirs) else abs(float(ours) - float(theirs)) <= 1e-6


def differences(figures, role, method, theirs):
    """Lines that say where the program and the ruler differ, and how many figures were compared."""
    lines, compared = [], 0
    classes = {key[2] for key in figures if key[:2] == (role, method)} - {"pooled", "macro", "all"}
    for class_name, metric in sorted(theirs):
        if class_name not in classes or metric == "samples":
            continue
        value = theirs[class_name, metric]

        def ours(name):
            return figures[role, method, class_name, name]

        if metric in COUNTS:
            agree, told = int(ours(metric)) == int(value), ours(metric)
        elif metric in MEANS:
            agree, told = means_agree(ours(metric), value), ours(metric)
        else:
            agree, told = distances_agree(ours, theirs, class_name, metric), "another share"
        compared += 1
        if not agree:
            lines.append(f"  {role} {method} {class_name} {metric}: program {told}, ruler {value}")
    return lines, compared


def compare_scores(mapscore, study, recording, folder):
    lines, compared = [], 0
    loaded = Recording(recording)
    for unit, K in study["runs"]:
        figures = swept(mapscore, study, recording, unit, K, folder)
        for role, method in sorted({key[:2] for key in figures}):
            if method not in CEILINGS_OF.get(role, METHODS_AND_PLACES):
                continue
            rows = ruler.score(loaded, ruler_options(study, recording, role, method, unit, K))[1:]
            more, count = differences(figures, role, method, {row[:2]: row[2] for row in rows})
            lines += [f"{line} ({unit}, K = {K})" for line in more]
            compared += count
    return lines, compared


def compare_truth(mapscore, study, recording, folder):
    """Rows of the truth, i, j, k, class, touch_only, samples, in any order."""
    file = os.path.join(folder, "truth.csv")
    origin = [str(value) for value in study["origin_m"]]
    program(mapscore, "truth", recording, "--origin_m", *origin, "--yaw_deg", str(study["yaw_deg"]), "-o", file)
    with open(file, encoding="utf-8", newline="") as text:
        ours = {tuple(row) for row in csv.reader(text)}
    arguments = ["truth", recording, "--origin_m", *origin, "--yaw_deg", str(study["yaw_deg"])]
    rows = ruler.truth_rows(Recording(recording), ruler.parse(arguments)[1])
    theirs = {tuple(map(str, row)) for row in rows}
    lines = [f"  truth: only the program has {','.join(row)}" for row in sorted(ours - theirs)]
    lines += [f"  truth: only the ruler has {','.join(row)}" for row in sorted(theirs - ours)]
    return lines, len(theirs)


def corners_of(shapes):
    return np.array([shape.bounds() for shape in shapes]).tobytes()


def keep_what_scores_share():
    """The ruler's surface truth of a lattice and its distances, made once, since all scores of a drive share them."""
    surface_truth, surface_distances, truths, distances = ruler.surface_truth, ruler.surface_distances, {}, {}

    def kept_truth(geoms, voxel, epsilon):
        key = corners_of([shape for _, shape in geoms]), voxel, epsilon
        if key not in truths:
            truths[key] = surface_truth(geoms, voxel, epsilon)
        return truths[key]

    def kept_distances(keys, shapes, voxel):
        known = distances.setdefault((corners_of(shapes), voxel), {})
        new = np.array([key for key in keys.tolist() if key not in known], np.int64)
        known.update(zip(new.tolist(), surface_distances(new, shapes, voxel)))
        return np.array([known[key] for key in keys.tolist()])

    ruler.surface_truth, ruler.surface_distances = kept_truth, kept_distances


def main(mapscore, scenes, drive):
    keep_what_scores_share()
    study, failed = STUDIES[drive], False
    with tempfile.TemporaryDirectory() as folder:
        recording = record(os.path.abspath(mapscore), os.path.abspath(scenes), study, folder)
        for what, compare in (("rows of truth", compare_truth), ("figures", compare_scores)):
            lines, compared = compare(os.path.abspath(mapscore), study, recording, folder)
            print(f"{drive}: {compared} {what} compared, {len(lines)} differ")
            print("\n".join(lines[:40]), end="\n" if lines else "")
            failed |= bool(lines) or compared == 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
