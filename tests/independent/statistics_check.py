#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds the statistics over seeds of `compare`, `table` and `figures` against scipy.

statistics_check.py PROGRAM    sweeps methods and doses over 22 seeds, takes one value a seed from the tidy table, and
    compares differences, intervals, p and what is pooled with what PROGRAM prints of 22, 12 and 8 of them
"""

import csv
import io
import json
import math
import os
import re
import sys
import tempfile
from decimal import Decimal

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import yaml

sys.dont_write_bytecode = True

from drives import program, record
from map_scores import COUNTS, joined_of, mean, voxel_ratios
from seed_statistics import holm, sign_flip_p, spread

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes", "apartment.xml")
TRAJECTORY = {"waypoints_m_deg": [[2.763, 4.813, -137], [1.413, 4.737, -38], [1.027, 2.963, -8], [1.143, 1.553, 22]],
              "frames_per_s": 0.23}
LEAF = "magnitude_m"
PATH, DOSES_M = f"faults.misregistration.{LEAF}", (0.0, 0.03)
STUDY = {
    "voxel_m": 0.1,
    "methods": {"direct": {"segmentation": {"direct": {}}}, "again": {"segmentation": {"direct": {}}},
                "erosion": {"segmentation": {"erosion": {"radius_px": 1}}},
                "growing": {"segmentation": {"region_growing": {"radius_factor": 1}}}},
    "faults": {"pose": {"sigma_xy_m": 0.03, "sigma_yaw_deg": 2}}, "sweep": {PATH: list(DOSES_M)},
    "score": {"threshold": 0.6}}  # a voxel must be hit twice, so that some seeds leave figures undefined
SEEDS = (22, 12, 8)  # random patterns of signs; an interval and all patterns; a range
GROUPS = ("pooled", "macro", "cup", "oven")
PAIRS = (("erosion", "direct"), ("growing", "erosion"), ("again", "direct"))
COMPARED = ("precision", "recall", "f1", "iou_4", "f1_t1", "f_2cm", "ap", "brier", "box_iou", "completeness_mean_m")
EXACT = frozenset(voxel_ratios(dict.fromkeys(COUNTS, 0)))  # ratios of counts, which make ties
DIGIT = 1e-9  # to which a tidy table tells the others
TABLE = {"precision": "precision", "recall": "recall", "F1": "f1", "IoU": "iou", "F1 tol. 1": "f1_t1"}
CEILINGS = {"registration F1": ("registration_ceiling", "f1"), "lattice precision": ("lattice_ceiling", "precision"),
            "lattice recall": ("lattice_ceiling", "recall")}
CURVES = {"value": "trial", **{role: role for role in ("registration_ceiling", "lattice_ceiling")}}


class Tidy:
    """Values of a tidy table, by role, method, dose, class and metric, one a seed."""

    def __init__(self, text):
        self.texts, self.known = {}, {}
        for row in csv.DictReader(io.StringIO(text)):
            key = row["role"], row["method"], float(row[PATH]), row["class"], row["metric"]
            self.texts.setdefault(key, []).append(row["value"])
        self.seeds = len(self.texts["trial", "direct", DOSES_M[0], "pooled", "visible"])
        self.classes = sorted({key[3] for key in self.texts} - {"pooled", "macro", "all"})

    def counts(self, *cell):
        """One dictionary a seed."""
        if cell not in self.known:
            columns = [map(int, self.texts[*cell, name]) for name in COUNTS]
            self.known[cell] = [dict(zip(COUNTS, values)) for values in zip(*columns)]
        return self.known[cell]

    def ratios(self, role, method, dose, group, seeds):
        """Ratios of counts pooled over some seeds; macro: mean over the classes that were visible."""
        if group != "macro":
            return voxel_ratios(joined_of([self.counts(role, method, dose, group)[seed] for seed in seeds]))
        counts = [joined_of([self.counts(role, method, dose, name)[seed] for seed in seeds]) for name in self.classes]
        rows = [voxel_ratios(of_class) for of_class in counts if of_class["visible"]]
        return {metric: mean([row[metric] for row in rows]) for metric in rows[0]}

    def by_seed(self, method, dose, group, metric):
        """One value a seed, None where undefined: exact from counts where it can be, else as told."""
        if metric in EXACT:
            return [self.ratios("trial", method, dose, group, [seed])[metric] for seed in range(self.seeds)]
        return [None if text == "-" else float(text) for text in self.texts["trial", method, dose, group, metric]]


class Findings:
    """Counts what was compared, keeps a line for what differs."""

    def __init__(self):
        self.compared, self.lines = 0, []
        self.middling_p = self.dropped = 0  # p that are neither small nor large, and rows that leave seeds out

    def hold(self, where, text, value, slack=0.0):
        """A printed number against a figure: half a unit of its last digit, and what the figure itself leaves open."""
        self.compared += 1
        if value is None or text == "-":
            agree = value is None and text == "-"
        else:
            half_unit = 0.5 * 10.0**Decimal(text).as_tuple().exponent
            agree = abs(float(text) - value) <= half_unit * (1 + 1e-6) + slack
        if not agree:
            self.lines.append(f"  {where}: program {text}, scipy {value}")

    def hold_equal(self, where, told, expected):
        self.compared += 1
        if told != expected:
            self.lines.append(f"  {where}: program {told}, not {expected}")


def compare_rows(mapscore, results, a, b, group, form):
    flags = "--group", group, "--metric", ",".join(COMPARED), "--format", form
    text = program(mapscore, "compare", results, a, b, *flags)
    return text if form == "csv" else json.loads(text)["rows"]


def row_expected(tidy, a, b, group, dose, metric):
    """({column: figure} of a row of `mapscore compare`, how far its p may lie off)."""
    both = [pair for pair in zip(tidy.by_seed(a, dose, group, metric), tidy.by_seed(b, dose, group, metric))
            if None not in pair]
    names = f"mean {a}", f"mean {b}", "difference", "low", "high", "p"
    if not both:
        return {"pairs": "0", "spread": "-", **dict.fromkeys(names)}, 0.0, {}
    of_a, of_b = zip(*both)
    d = [x - y for x, y in both]
    p, luck = sign_flip_p(of_a, of_b, 0.0 if metric in EXACT else DIGIT)
    kind = "range" if len(both) < 10 else "95% interval"
    of_ends = (0.0, 0.0) if metric in EXACT else told_error_of_ends(of_a, of_b)
    return {"pairs": str(len(both)), "spread": kind,
            **dict(zip(names, (mean(of_a), mean(of_b), mean(d), *spread(d), p), strict=True))}, luck, dict(
                zip(("low", "high"), of_ends, strict=True))


def told_error(value):
    """Half a unit of the last of nine significant digits."""
    return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - 8) if value else 0.0


def told_error_of_ends(of_a, of_b):
    """By how much both ends may be off, to first order, since the seeds' values are told to nine digits."""
    d = [x - y for x, y in zip(of_a, of_b)]
    before, errors = spread(d), [0.0, 0.0]
    for i, (x, y) in enumerate(zip(of_a, of_b)):
        off = told_error(x) + told_error(y)
        after = spread(d[:i] + [d[i] + off] + d[i + 1:])
        errors = [error + abs(b - a) for error, b, a in zip(errors, before, after)]
    return errors


def check_compare(findings, tidy, text, a, b, group):
    """One table of `mapscore compare`: figures and p of every row, then Holm's correction of them all."""
    rows, ps, loose = list(csv.DictReader(io.StringIO(text))), [], 0.0
    cells = {(float(row[LEAF]), row["metric"]) for row in rows}
    where = f"{tidy.seeds} seeds, {a} - {b}, {group}"
    findings.hold_equal(f"{where}: rows", cells, {(dose, metric) for dose in DOSES_M for metric in COMPARED})
    for row in rows:
        expected, luck, of_ends = row_expected(tidy, a, b, group, float(row[LEAF]), row["metric"])
        for name, value in expected.items():
            here = f"{where}, {row[LEAF]} m, {row['metric']}: {name}"
            if name in ("pairs", "spread"):
                findings.hold_equal(here, row[name], value)
            else:
                findings.hold(here, row[name], value,
                              luck + 1e-12 if name == "p" else max(2 * DIGIT, of_ends.get(name, 0.0)))
        p = expected["p"]
        findings.middling_p += p is not None and 0.01 < p < 0.9
        findings.dropped += 0 < int(row["pairs"]) < tidy.seeds
        ps.append(float(row["p"]) if luck and p is not None and row["p"] != "-" else p)
        loose = max(loose, len(rows) * 0.5e-4 if luck else 1e-12)  # these are known as printed alone
    for row, p in zip(rows, holm(ps)):
        findings.hold(f"{where}, {row[LEAF]} m, {row['metric']}: p (Holm)", row["p (Holm)"], p, loose)


def check_json(findings, text, rows, where):
    """The same rows as the CSV's, number for number."""
    for ours, theirs in zip(rows, csv.DictReader(io.StringIO(text)), strict=True):
        for name, value in theirs.items():
            told = ours[name]
            numbers = not isinstance(told, str) and told is not None
            findings.hold_equal(f"{where}, {name} as json", float(told) if numbers else told,
                                float(value) if numbers else None if told is None and value == "-" else value)


def shares_spread(values):
    """Of figures from 0 to 1, at which the interval is cut off."""
    return tuple(end and min(max(end, 0.0), 1.0) for end in spread(values))


def check_table(findings, tidy, text, group):
    """`mapscore table`: ratios of counts pooled over the seeds, F1's spread by seed, ceilings."""
    everything = range(tidy.seeds)
    for row in csv.DictReader(io.StringIO(text)):
        dose, method = float(row[LEAF]), row["method"]
        where = f"table, {tidy.seeds} seeds, {method}, {group}, {dose} m"
        pooled = tidy.ratios("trial", method, dose, group, everything)
        for column, metric in TABLE.items():
            findings.hold(f"{where}: {column}", row[column], pooled[metric])
        for column, (role, metric) in CEILINGS.items():
            findings.hold(f"{where}: {column}", row[column], tidy.ratios(role, method, dose, group, everything)[metric])
        defined = [value for value in tidy.by_seed(method, dose, group, "f1") if value is not None]
        for end, value in zip(("low", "high"), shares_spread(defined), strict=True):
            findings.hold(f"{where}: F1 {end}", row[f"F1 {end}"], value, 2 * DIGIT)


def check_curves(findings, tidy, folder):
    """Numbers of the figures, in nine digits: value, low, high and ceilings over the dose in mm."""
    for name in ("accuracy_by_dose.dat", "by_class_by_dose.dat"):
        with open(os.path.join(folder, name), encoding="utf-8") as text:
            blocks = [block.splitlines() for block in text.read().strip().split("\n\n\n")]
        for head, columns, *lines in blocks:
            method, group, metric = re.fullmatch(r"# (\w+); (\w+) (\w+)", head).groups()
            if columns != "# x value low high registration_ceiling lattice_ceiling":
                raise ValueError(f"{name}: unknown columns, {columns}")
            for dose, line in zip(DOSES_M, lines, strict=True):
                low, high = shares_spread([v for v in tidy.by_seed(method, dose, group, metric) if v is not None])
                expected = {"x": 1000 * dose, "low": low, "high": high}
                for column, role in CURVES.items():
                    pooled = tidy.ratios(role, method, dose, group, range(tidy.seeds))
                    expected.update({column: pooled[metric]} if metric in pooled else {})
                told = dict(zip(columns.split()[1:], line.split(), strict=True))
                where = f"{name}, {tidy.seeds} seeds, {head} at {dose} m"
                for column, value in expected.items():
                    findings.hold(f"{where}: {column}", told[column], value, 2 * DIGIT)


def check_seeds(findings, mapscore, results):
    tidy = Tidy(program(mapscore, "table", results, "--tidy"))
    for group in GROUPS:
        check_table(findings, tidy, program(mapscore, "table", results, "--class", group, "--format", "csv"), group)
        for a, b in PAIRS:
            check_compare(findings, tidy, compare_rows(mapscore, results, a, b, group, "csv"), a, b, group)
    a, b = PAIRS[0]
    once, twice = (compare_rows(mapscore, results, a, b, "pooled", "csv") for _ in range(2))
    findings.hold_equal(f"{tidy.seeds} seeds: the same call twice", twice, once)
    rows = compare_rows(mapscore, results, a, b, "pooled", "json")
    check_json(findings, once, rows, f"{tidy.seeds} seeds, {a} - {b}")
    program(mapscore, "figures", results, "--no_pictures")
    check_curves(findings, tidy, os.path.join(results, "figures"))


def main(mapscore):
    mapscore, findings = os.path.abspath(mapscore), Findings()
    with tempfile.TemporaryDirectory() as folder:
        recording = record(mapscore, os.path.abspath(SCENE), TRAJECTORY, folder)
        file, whole = os.path.join(folder, "study.yaml"), os.path.join(folder, f"seeds{SEEDS[0]}")
        with open(file, "w", encoding="utf-8") as text:
            yaml.safe_dump({"recording": recording, **STUDY}, text)
        for seeds in SEEDS:
            results = os.path.join(folder, f"seeds{seeds}")
            merged = () if results == whole else ("--merge", whole)
            program(mapscore, "sweep", file, "-o", results, "-q", "--set", f"seeds={seeds}", *merged)
            before = findings.compared
            check_seeds(findings, mapscore, results)
            print(f"{seeds} seeds: {findings.compared - before} figures compared", flush=True)
    print(f"{findings.compared} figures compared, {len(findings.lines)} differ; "
          f"{findings.middling_p} p between 0.01 and 0.9, {findings.dropped} rows without some seeds")
    print("\n".join(findings.lines[:40]), end="\n" if findings.lines else "")
    return 1 if findings.lines or not (findings.compared and findings.middling_p and findings.dropped) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
