# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds frames.csv of `mapscore run` against the ruler's scores of each frame, and sums over it against the trial."""

import csv
import glob
import io
import os

import ruler
from agreement import differences
from drives import program
from recording import table_rows


def swept(mapscore, study_file, results):
    """(role, method, class, metric) -> text of a sweep with one seed."""
    program(mapscore, "sweep", study_file, "-o", results, "-q")
    rows = csv.DictReader(io.StringIO(program(mapscore, "table", results, "--tidy")))
    return {(row["role"], row["method"], row["class"], row["metric"]): row["value"] for row in rows}


def frames_told(mapscore, study_file, method, folder):
    """[stamp, {(class, metric): text}] a frame, in the order of frames.csv, whose numbers count from 0."""
    program(mapscore, "run", study_file, "-o", folder, "-q", "--method", method)
    found = glob.glob(os.path.join(folder, "runs", f"{method}-seed0-*", "frames.csv"))
    if len(found) != 1:
        raise ValueError(f"{folder}: {len(found)} files frames.csv of a run, not 1")
    frames = []
    with open(found[0], encoding="utf-8", newline="") as text:
        for row in csv.DictReader(text):
            if int(row["frame"]) == len(frames):
                frames.append((row["stamp_s"], {}))
            if int(row["frame"]) != len(frames) - 1 or row["stamp_s"] != frames[-1][0]:
                raise ValueError(f"{found[0]}: frame {row['frame']}, {row['stamp_s']} s, is out of order")
            frames[-1][1][row["class"], row["metric"]] = row["value"]
    return frames


def compare_frames(mapscore, study_file, method, recording, options, folder):
    """Lines of differences and how many figures were compared: every row of frames.csv, stamps, and sums of counts."""
    scores, maps = ruler.maps_of(recording, options)
    frames = frames_told(mapscore, study_file, method, os.path.join(folder, "run"))
    lines, compared = [], 1
    stamps = [float(row[0]) for row in table_rows(recording.path("color.txt"))]
    if [float(stamp) for stamp, _ in frames] != stamps:
        lines.append(f"  frames.csv: stamps {[stamp for stamp, _ in frames]}, in the recording {stamps}")
    groups = {recording.names[label] for label in recording.detected} | {"pooled"}
    sums = {}
    for number, ((_, ours), one) in enumerate(zip(frames, maps)):
        theirs = {key: value for key, value in scores.figures([one]).items() if key[0] in groups}
        lines += differences(f"frame {number}, {method}", ours, theirs)
        compared += len(theirs)
        for key, value in theirs.items():
            if isinstance(value, int):
                sums[key] = sums.get(key, 0) + int(ours.get(key, 0))
    trial = {key[2:]: text for key, text in swept(mapscore, study_file, os.path.join(folder, "swept")).items()
             if key[:2] == ("trial", method) and key[2:] in sums}
    lines += differences(f"sum over frames, {method}", trial, sums)
    return lines, compared + len(sums)
