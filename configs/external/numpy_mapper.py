#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A mapper in numpy, to begin one's own with: python3 numpy_mapper.py TRIAL MAP.csv

Reads a trial folder (docs/formats.md), puts the depth points behind each detection's mask into voxels, and blends the
classes of a voxel over the frames. At one draw a frame that is mapscore's own method `direct`, voxel by voxel.
"""

import csv
import sys

import numpy as np
import yaml
from PIL import Image

K = 0.5  # weight of what the map held before


def rows(name):
    with open(f"{trial}/{name}", newline="") as file:
        return list(csv.DictReader(file))


def matrix(numbers):
    return np.vstack([np.array(list(numbers), float).reshape(3, 4), [0, 0, 0, 1]])


def moved(T, p):  # p: 3 x n
    return [T[i, 0] * p[0] + T[i, 1] * p[1] + T[i, 2] * p[2] + T[i, 3] for i in range(3)]


def registered(depth):
    """For each colour pixel the number of the depth pixel that it sees, or -1; and all points, 3 x n (docs/methods.md)."""
    color, camera = info["color"], info["depth"]
    v, u = np.indices(depth.shape).reshape(2, -1)
    z = depth.reshape(-1) / 5000.0
    p = [z * ((u - camera["cx_px"]) / camera["fx_px"]), z * ((v - camera["cy_px"]) / camera["fy_px"]), z]
    x, y, z_color = moved(matrix(info["T_color_depth"]), p)
    n = np.flatnonzero((z >= camera["range_min_m"]) & (z <= camera["range_max_m"]) & (z_color > 0))
    at = [color[f] * q[n] / z_color[n] + color[c] for f, q, c in (("fx_px", x, "cx_px"), ("fy_px", y, "cy_px"))]
    half = [np.maximum(1, color[f] / camera[f] * (z[n] / z_color[n])) / 2 for f in ("fx_px", "fy_px")]
    pixel, source = [], []
    for du in (-1, 0, 1):
        for dv in (-1, 0, 1):
            col, row = np.rint(at[0]) + du, np.rint(at[1]) + dv
            covered = (np.abs(col - at[0]) <= half[0]) & (np.abs(row - at[1]) <= half[1])
            covered &= (col >= 0) & (row >= 0) & (col < color["width_px"]) & (row < color["height_px"])
            pixel.append((row * color["width_px"] + col)[covered].astype(int))
            source.append(n[covered])
    pixel, source = np.concatenate(pixel), np.concatenate(source)
    order = np.lexsort((source, z_color[source], pixel))  # of each colour pixel the nearest first
    pixel, first = np.unique(pixel[order], return_index=True)
    seen = np.full(color["width_px"] * color["height_px"], -1)
    seen[pixel] = source[order][first]
    return seen, np.array(p)


trial, output = sys.argv[1:]
info = yaml.safe_load(open(f"{trial}/trial.yaml"))
beliefs, meanings, voxels = rows("beliefs.csv"), rows("detections.csv"), {}
for frame, belief in zip(rows("frames.csv"), beliefs):
    numbers = list(belief.values())
    T_map_depth = matrix(numbers[2:14]) @ matrix(numbers[14:26]) @ matrix(info["T_base_depth"])
    found = [row for row in meanings if row["frame"] in ("*", frame["frame"])]
    labels = {}  # by layer: where masks overlap, the further ones stand in label_1/, label_2/, ...
    for layer in {row["layer"] for row in found}:
        folder = f"label_{layer}" if layer != "0" else "label"
        labels[layer] = np.array(Image.open(trial + "/" + folder + frame["label"].removeprefix("label"))).reshape(-1)
    seen, points = registered(np.array(Image.open(f"{trial}/{frame['depth']}")))
    hits = {}  # (voxel, class): points, best score
    for one in found:
        sources = seen[labels[one["layer"]] == int(one["id"])]
        keys = np.floor(np.array(moved(T_map_depth, points[:, sources[sources >= 0]])) / info["voxel_m"]).astype(int)
        for key, count in zip(*np.unique(keys.T, axis=0, return_counts=True)):
            before = hits.get((tuple(key), int(one["class"])), (0, 0.0))
            hits[tuple(key), int(one["class"])] = (before[0] + count, max(before[1], float(one["score"])))
    winners = {}
    for (key, c), (count, score) in sorted(hits.items()):  # most points, ties to the lower class
        if count > winners.get(key, (0,))[0]:
            winners[key] = (count, c, score)
    for key, (_, c, score) in winners.items():
        probabilities = voxels.setdefault(key, np.zeros(len(info["classes"])))
        probabilities *= K
        probabilities[c] += (1 - K) * score

with open(output, "w") as file:
    file.write("i,j,k,class,probability\n")
    for key, probabilities in voxels.items():
        file.write(f"{key[0]},{key[1]},{key[2]},{probabilities.argmax()},{probabilities.max():.17g}\n")
