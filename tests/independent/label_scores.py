# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Label images against a recording's own, by docs/metrics.md."""

import os

import numpy as np
from PIL import Image
from scipy import ndimage

from map_scores import mean, ratio


def write_labels(folder, recording, random, palette=False):
    """Class ids by pixel, some of them wrong in blocks; grey of 8 or 16 bits in turn, or a palette."""
    os.makedirs(folder)
    names = list(recording.names)
    for n, (label_path, *_) in enumerate(recording.frames):
        said = recording.classes_of(recording.read_image(label_path))
        for _ in range(9):
            v, u = random.integers(0, said.shape[0]), random.integers(0, said.shape[1])
            said[v:v + 17, u:u + 23] = random.choice(names)
        image = Image.fromarray(said.astype(np.uint16 if n % 2 and not palette else np.uint8))
        if palette:
            image = image.convert("L")
            image.putpalette(list(random.integers(0, 256, 768)))
        image.save(os.path.join(folder, os.path.basename(label_path)))


def edge(mask):
    """Pixels of a class beside another class; the image's border is none."""
    return mask & ~ndimage.binary_erosion(mask, border_value=1)


def near(edges, others, pixels):
    """How many of the edges lie within so many pixels of one of the others."""
    if not others.any():
        return 0
    return int((ndimage.distance_transform_edt(~others)[edges] <= pixels + 1e-9).sum())


def edge_counts(true, said, c):
    """Edge pixels of a class: true, of these found, said, of these right."""
    pixels = max(1, round(0.0075 * np.hypot(*true.shape)))
    a, b = edge(true == c), edge(said == c)
    return np.array([a.sum(), near(a, b, pixels), b.sum(), near(b, a, pixels)], np.int64)


def boundary_f(true, found, said, right):
    if true == 0 and said == 0:
        return None
    precision, recall = ratio(int(right), int(said)) or 0, ratio(int(found), int(true)) or 0
    return 2 * precision * recall / (precision + recall) if precision + recall > 0 else 0.0


def label_scores(folder, recording, frames):
    count = max(recording.names) + 1
    table = np.zeros((count, count), np.int64)
    edges = {c: np.zeros(4, np.int64) for c in recording.names}
    for n in frames:
        path = recording.frames[n][0]
        true = recording.classes_of(recording.read_image(path))
        said = recording.read_image(os.path.join(folder, os.path.basename(path)))
        for c in edges:
            edges[c] += edge_counts(true, said, c)
        table += np.bincount((count * true + said).reshape(-1), minlength=count * count).reshape(count, count)
    diagonal, rows, columns = table.diagonal(), table.sum(axis=1), table.sum(axis=0)
    accuracy = {c: ratio(int(diagonal[c]), int(rows[c])) for c in recording.names}
    iou = {c: ratio(int(diagonal[c]), int(rows[c] + columns[c] - diagonal[c])) for c in recording.names}
    boundary = {c: boundary_f(*edges[c]) for c in recording.names}
    shown = [c for c in recording.names if rows[c]]
    result = {("all", "pa"): ratio(int(diagonal.sum()), int(table.sum())),
              ("all", "mpa"): mean([accuracy[c] for c in shown]), ("all", "miou"): mean([iou[c] for c in shown]),
              ("all", "fwiou"): sum(int(rows[c]) * iou[c] for c in shown) / int(table.sum()),
              ("all", "boundary_f"): mean([boundary[c] for c in shown])}
    for c, name in recording.names.items():
        result[name, "accuracy"], result[name, "iou"], result[name, "boundary_f"] = accuracy[c], iou[c], boundary[c]
        for d, other in recording.names.items():
            if table[c, d]:
                result[name, f"taken_for:{other}"] = int(table[c, d])
    return result
