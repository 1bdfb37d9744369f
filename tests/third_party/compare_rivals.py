#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds edge_aligned against its rivals on kitchens and workplaces of other people's packages.

Run by hand: it downloads a gigabyte, and takes some minutes a scene. Every body but floors and walls is detected. What
stands in the folder already is not made again. Needs numpy, OpenCV, PyYAML and network.

    tests/third_party/compare_rivals.py build/release/mapscore /tmp/rivals
    tests/third_party/compare_rivals.py build/release/mapscore /tmp/rivals fetch --sweep faults.labels.boundary_px=[-2,2]
"""

import argparse
import csv
import io
import os
import re
import shutil
import subprocess
import sys

import cv2
import numpy as np
import yaml

sys.dont_write_bytecode = True

from poses import trajectory
from record_scenes import HERE, HOME, ROBOT, run, voxels
from scenes import COMPARED, Workshop

STUDY = os.path.join(HERE, "..", "..", "configs", "rivals.yaml")
BUILDING = re.compile("(floor|wall|ground|room|world)[0-9]*")
MOST_VOXELS = 60000  # that a way of looking is chosen on
OURS = "edge_aligned"


def is_kitchen(scene):
    return "kitchen" in scene.name


def voxel_m(scene):
    return 0.05 if is_kitchen(scene) else 0.02


def detected(mapscore, file):
    """Classes of a scene but floors and walls, one for each name of bodies."""
    listed = run(mapscore, "info", file, "--no_picture")  # id, class, colour, ...; names may have spaces
    names = re.findall("^ *[1-9][0-9]*  (.+?) +[0-9A-F]{6} ", listed, re.MULTILINE)
    return [name for name in names if not BUILDING.fullmatch(name)]


def centres_of(mapscore, scene, file, folder):
    """N x 3, metres: of the truth's voxels of what is detected, of many a part."""
    centres = voxels(mapscore, file, voxel_m(scene), folder, BUILDING.fullmatch)
    if len(centres) > MOST_VOXELS:
        centres = centres[np.random.default_rng(0).permutation(len(centres))[:MOST_VOXELS]]
    return centres


def record(mapscore, workshop, scene, seed):
    """Folder of a recording: of a kitchen 22 frames that show 7 objects or more, of a workplace 20 that show 2."""
    folder = os.path.join(workshop.folder, "recordings", f"{scene.name}_{seed}")
    if os.path.isdir(folder):
        return folder
    file = workshop.file_of(scene)
    work = os.path.join(workshop.folder, "work", scene.name)
    os.makedirs(work, exist_ok=True)
    tried, most, least = (44, 22, 7) if is_kitchen(scene) else (24, 20, 2)
    poses, trial = os.path.join(work, "poses.txt"), os.path.join(work, "trial")
    head, *lines = trajectory(centres_of(mapscore, scene, file, work), voxel_m(scene), tried, seed).splitlines()

    def record_into(target, chosen):
        with open(poses, "w", encoding="utf-8") as text:
            text.write("\n".join([head, *chosen]) + "\n")
        run(mapscore, "record", file, "--trajectory", poses, "-o", target, "-q", "--set", f"robot={ROBOT}")

    shutil.rmtree(trial, ignore_errors=True)
    record_into(trial, lines)
    labels = sorted(os.listdir(os.path.join(trial, "label")))
    shown = [len(np.unique(cv2.imread(os.path.join(trial, "label", name), cv2.IMREAD_UNCHANGED))) - 1
             for name in labels]
    record_into(folder, [line for line, objects in zip(lines, shown) if objects >= least][:most])
    shutil.rmtree(trial)
    return folder


def f1_of(mapscore, study, results):
    """F1 by value of what is swept and by method, means over seeds; sweeps what is missing."""
    run(mapscore, "sweep", study, "-o", results, "-q")
    values = {}
    for row in csv.reader(io.StringIO(run(mapscore, "table", results, "--tidy"))):
        role, method, _, dose, group, metric, value = row
        if (role, group, metric) == ("trial", "pooled", "f1"):
            values.setdefault(dose, {}).setdefault(method, []).append(float(value))
    return {dose: {method: np.mean(ones) for method, ones in methods.items()} for dose, methods in values.items()}


def compare(mapscore, workshop, scene, key, doses, arguments):
    with open(STUDY, encoding="utf-8") as text:
        study = yaml.safe_load(text)
    del study["scenes"]
    study.update(name=scene.name, recording=record(mapscore, workshop, scene, arguments.seed), voxel_m=voxel_m(scene),
                 detect=detected(mapscore, workshop.file_of(scene)), sweep={key: doses}, seeds=arguments.seeds)
    name = f"{scene.name}_{arguments.seed}_{key}"
    file = os.path.join(workshop.folder, f"{name}.yaml")
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump(study, text, sort_keys=False)
    for dose, f1 in f1_of(mapscore, file, os.path.join(workshop.folder, "results", name)).items():
        best = max((method for method in f1 if method != OURS), key=f1.get)
        print(f"{scene.name:<20} {key.split('.')[-1]:>14} {dose:>6}  {OURS} {f1[OURS]:.4f}  direct {f1['direct']:.4f}  "
              f"best rival {f1[best]:.4f} {best:<14} {f1[OURS] - f1[best]:+.4f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mapscore")
    parser.add_argument("folder", help="where packages, recordings and results are kept")
    parser.add_argument("names", nargs="*", help="only these scenes")
    parser.add_argument("--sweep", default="faults.misregistration.magnitude_m=[0,0.005,0.02,0.05]",
                        help="a key of studies and its values [%(default)s]")
    parser.add_argument("--seed", type=int, default=29, help="of the places that the camera looks from [%(default)s]")
    parser.add_argument("--seeds", type=int, default=2, help="of the faults [%(default)s]")
    arguments = parser.parse_intermixed_args()
    known = {scene.name: scene for scene in COMPARED}
    unknown = set(arguments.names) - set(known)
    if unknown:
        parser.error(f"no scene {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    key, equals, doses = arguments.sweep.partition("=")
    if not equals or not isinstance(yaml.safe_load(doses), list):
        parser.error(f"--sweep {arguments.sweep}: write KEY=[VALUE,VALUE]")
    workshop = Workshop(arguments.folder, HOME)
    failed = 0
    for name in arguments.names or known:
        try:
            compare(arguments.mapscore, workshop, known[name], key, yaml.safe_load(doses), arguments)
        except (RuntimeError, OSError, ValueError, subprocess.CalledProcessError) as error:
            reason = error.stderr if isinstance(error, subprocess.CalledProcessError) else str(error)
            print(f"{name}: FAILED {(reason or str(error)).strip()[-300:]}", flush=True)
            failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
