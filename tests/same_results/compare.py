#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds two builds against each other: a change that is to change no result changes no byte of it.

    tests/same_results/compare.py BASE NEW FOLDER              everything; BASE and NEW are build folders
    tests/same_results/compare.py BASE NEW FOLDER --only keys gate demo

BASE and NEW need the program `mapscore`, and for `keys` mapscore_dump_plan (cmake --build ... --target
mapscore_dump_plan; an older version is given tests/same_results/dump_plan.cpp first). Compared are

  keys      for all studies in configs/: resolved configuration and text behind the key of every cell, and the page of keys
  STUDY     tidy CSV of a sweep at one seed, each program on a recording that it renders itself
  run       files of `run`, pictures by their pixels
  map       .ot, .ply and what is printed, of two segmentations
  objects   objects.yaml, .xml, .ply and the table
  score     --tidy of three maps in three formats
  segment   all files of a frame

Prints a line for each and the processor time of both; exit code 1 with any difference. Runs of the two programs are
interleaved, so that their times compare.
"""

import argparse
import io
import os
import resource
import shutil
import subprocess
import sys

from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
CONFIGS = os.path.join(HERE, "..", "..", "configs")
STUDIES = ("gate demo person home crf covariance person_offset person_sequence paper_home paper_person paper_fusion_labels "
           "paper_fusion_pose segmentation_home").split()
MEASURED = ("frames.csv",)  # hold times


class Side:
    """One build, its folder of work and the processor time it took."""

    def __init__(self, build, work):
        self.build, self.work, self.seconds = os.path.abspath(build), os.path.abspath(work), 0.0
        os.makedirs(self.work, exist_ok=True)

    def run(self, program, *arguments):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([program, *arguments], cwd=self.work, capture_output=True, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return done.stdout + f"\nexit code {done.returncode}\n".encode() + (done.stderr if done.returncode else b"")

    def mapscore(self, *arguments):
        return self.run(os.path.join(self.build, "mapscore"), *arguments)


def config(name):
    return os.path.join(CONFIGS, name + ".yaml")


def pixels(data):
    """Of a picture: versions may compress it in other ways."""
    with Image.open(io.BytesIO(data)) as picture:
        return picture.mode.encode() + repr(picture.size).encode() + picture.tobytes()


def files_of(folder):
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            if name not in MEASURED:
                with open(path, "rb") as file:
                    data = file.read()
                found[os.path.relpath(path, folder)] = pixels(data) if name.endswith(".png") else data
    return found


def keys(side):
    studies = sorted(os.path.join(CONFIGS, name) for name in os.listdir(CONFIGS) if name.endswith(".yaml"))
    dumped = side.run(os.path.join(side.build, "mapscore_dump_plan"), *studies)
    return {"keys": dumped.replace(b"the field lists of eval/experiment/study_fields.hpp", b"").replace(
        b"the lists of fields of the parameters (core/parameters.hpp)", b"")}


def sweep(side, name, *more):
    printed = side.mapscore("sweep", config(name), "-o", name, "-q", "--set", "seeds=1", *more)
    seconds = side.seconds
    tidy = side.mapscore("table", name, "--tidy")
    side.seconds = seconds
    return {"printed": printed, "tidy": tidy}


def recording_of(side):
    if not os.path.isdir(os.path.join(side.work, "demo", "recordings")):
        sweep(side, "demo")
    folder = os.path.join("demo", "recordings")
    return os.path.join(folder, sorted(os.listdir(os.path.join(side.work, folder)))[0])


def run(side):
    recording_of(side)
    printed = side.mapscore("run", config("demo"), "-o", "demo", "-q")
    return {"printed": printed, **files_of(os.path.join(side.work, "demo", "runs"))}


def maps(side):
    recording, found = recording_of(side), {}
    for name, flags in {"default": [], "erosion": ["--segmentation", "erosion", "--radius_px", "3", "--voxel_m", "0.04"]}.items():
        found[name] = side.mapscore("map", recording, "-o", name + ".ot", "--ply", name + ".ply", "--color", name + "_colour.ot",
                                    "-q", *flags)
    for file in ("default.ot", "default.ply", "default_colour.ot", "erosion.ot", "erosion.ply"):
        with open(os.path.join(side.work, file), "rb") as data:
            found[file] = data.read()
    return found


def objects(side):
    printed = side.mapscore("objects", recording_of(side), "-o", "objects", "-q", "--method", "region_growing")
    return {"printed": printed, **files_of(os.path.join(side.work, "objects"))}


def score(side):
    recording = recording_of(side)
    maps(side)
    side.mapscore("truth", recording, "-o", "truth.csv", "-q")
    return {file: side.mapscore("score", file, "--truth", recording, "--tidy", "-q")
            for file in ("default.ot", "erosion.ply", "truth.csv")}


def segment(side):
    recording, found = recording_of(side), {}
    for method in ("direct", "erosion", "region_growing", "edge_aligned"):
        shutil.rmtree(os.path.join(side.work, "segments_" + method), ignore_errors=True)
        found[method] = side.mapscore("segment", recording, "--frame", "5", "--method", method, "-o", "segments_" + method)
        for file, data in files_of(os.path.join(side.work, "segments_" + method)).items():
            found[f"{method}/{file}"] = data
    return found


OTHERS = {"keys": keys, "run": run, "map": maps, "objects": objects, "score": score, "segment": segment}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("new")
    parser.add_argument("folder")
    parser.add_argument("--only", nargs="+", choices=[*OTHERS, *STUDIES], default=[*OTHERS, *STUDIES])
    parser.add_argument("--set", action="append", default=[], help="of every sweep, such as trajectory.max_frames=10")
    arguments = parser.parse_args()
    sides = [Side(arguments.base, os.path.join(arguments.folder, "base")), Side(arguments.new, os.path.join(arguments.folder, "new"))]
    more = [word for one in arguments.set for word in ("--set", one)]
    differ = 0
    for name in arguments.only:
        results = [OTHERS[name](side) if name in OTHERS else sweep(side, name, *more) for side in sides]
        # Folders stand in what is printed.
        different = [key for key in sorted(set(results[0]) | set(results[1]))
                     if results[0].get(key, b"").replace(sides[0].work.encode(), b"") !=
                     results[1].get(key, b"").replace(sides[1].work.encode(), b"")]
        differ += bool(different)
        ratio = sides[1].seconds / sides[0].seconds if sides[0].seconds else float("nan")
        verdict = "DIFFER: " + ", ".join(different) if different else f"equal, {len(results[0])} of them"
        print(f"{name:20} {verdict:40} {sides[0].seconds:8.1f} s  {sides[1].seconds:8.1f} s  {ratio:5.2f}", flush=True)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
