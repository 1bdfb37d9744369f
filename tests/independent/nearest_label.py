#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Measures how far Hydra's look-up of labels is from `direct` (docs/methods.md, segmentation).

nearest_label.py RECORDING [SHIFT_MM ...]    of every third frame, under a believed T_color_depth shifted along x: depth pixels
    that direct (nearest pixel) and Hydra's adaptive rule (vote of four pixels unless their depths differ by more than 0.2 m)
    give different detected instances, and F1 of the frames' 5 cm voxels by class against depth_label, for both
"""

import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

sys.dont_write_bytecode = True

from recording import Recording, moved
from segmentation import register

DIFFERENCE_M, TRUNCATION_M, VOXEL_M = 0.2, 0.1, 0.05


def looked_up(labels, ranges, at_u, at_v):
    """(label by the nearest pixel, label and range by the adaptive rule) of positions in the image; label 0 outside."""
    height, width = labels.shape
    near_u, near_v = np.floor(at_u + 0.5).astype(int), np.floor(at_v + 0.5).astype(int)
    inside = (near_u >= 0) & (near_u < width) & (near_v >= 0) & (near_v < height)
    near_u, near_v = np.clip(near_u, 0, width - 1), np.clip(near_v, 0, height - 1)
    nearest = np.where(inside, labels[near_v, near_u], 0)
    u, v = np.floor(at_u).astype(int), np.floor(at_v).astype(int)
    square = (u >= 0) & (v >= 0) & (u < width - 1) & (v < height - 1)
    u, v = np.clip(u, 0, width - 2), np.clip(v, 0, height - 2)
    du, dv = at_u - u, at_v - v
    corners = [(0, 0, (1 - du) * (1 - dv)), (1, 0, (1 - du) * dv), (0, 1, du * (1 - dv)), (1, 1, du * dv)]
    around = np.stack([ranges[v + y, u + x] for y, x, _ in corners])
    ids = np.stack([labels[v + y, u + x] for y, x, _ in corners])
    weights = np.stack([weight for _, _, weight in corners])
    votes = np.stack([(weights * (ids == ids[k])).sum(0) for k in range(4)])
    voted = np.take_along_axis(ids, votes.argmax(0)[None], 0)[0]
    smooth = square & (np.ptp(around, axis=0) <= DIFFERENCE_M)
    return nearest, np.where(smooth, voted, nearest), np.where(smooth, (weights * around).sum(0), ranges[near_v, near_u])


def voxels(points, classes):
    """The set of (class, voxel) that labelled points hit."""
    keep = classes > 0
    return set(map(tuple, np.c_[classes[keep], np.floor(points[keep] / VOXEL_M).astype(int)]))


def compare(recording, shift_m):
    believed = recording.T_color_depth.copy()
    believed[0, 3] += shift_m
    detected = np.isin(recording.class_of, list(recording.detected))
    differing = labelled = 0
    hits = {"direct": np.zeros(3), "adaptive": np.zeros(3)}
    for frame in recording.frames[::3]:
        points = recording.cloud(recording.read_depth(frame[1]))
        source = register(recording, points, believed)
        labels = recording.read_image(frame[0])
        labels = np.where(detected[labels], labels, 0)
        seen = moved(believed, points)
        ranges = np.where(source >= 0, np.linalg.norm(seen, axis=1)[source], 0)
        winners = np.unique(source[source >= 0])  # the points of the registered cloud, as direct has them
        p = seen[winners]
        at = [recording.color[f] * p[:, k] / p[:, 2] + recording.color[c] for k, f, c in ((0, "fx_px", "cx_px"), (1, "fy_px", "cy_px"))]
        nearest, adaptive, surface = looked_up(labels, ranges, *at)
        adaptive = np.where(np.abs(surface - np.linalg.norm(p, axis=1)) < TRUNCATION_M, adaptive, 0)
        differing += (nearest != adaptive).sum()
        labelled += (nearest > 0).sum()
        instances = recording.read_image(frame[2]).ravel()[winners]
        truth = voxels(points[winners], np.where(detected[instances], recording.class_of[instances], 0))
        for name, found in (("direct", nearest), ("adaptive", adaptive)):
            mapped = voxels(points[winners], np.where(found > 0, recording.class_of[found], 0))
            hits[name] += [len(mapped & truth), len(mapped), len(truth)]
    scores = ", ".join(f"F1 {name} {2 * n[0] / (n[1] + n[2]):.4f}" for name, n in hits.items())
    print(f"{1000 * shift_m:g} mm: {differing} of {labelled} labelled points differ ({differing / labelled:.2%}), {scores}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for shift in sys.argv[2:] or ["0", "20", "50"]:
        compare(Recording(sys.argv[1]), float(shift) / 1000)
