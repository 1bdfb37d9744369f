# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Label images against a recording's own, by docs/metrics.md."""

import os

import numpy as np
from PIL import Image

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


def label_scores(folder, recording, frames):
    count = max(recording.names) + 1
    table = np.zeros((count, count), np.int64)
    for n in frames:
        path = recording.frames[n][0]
        true = recording.classes_of(recording.read_image(path))
        said = recording.read_image(os.path.join(folder, os.path.basename(path)))
        table += np.bincount((count * true + said).reshape(-1), minlength=count * count).reshape(count, count)
    diagonal, rows, columns = table.diagonal(), table.sum(axis=1), table.sum(axis=0)
    accuracy = {c: ratio(int(diagonal[c]), int(rows[c])) for c in recording.names}
    iou = {c: ratio(int(diagonal[c]), int(rows[c] + columns[c] - diagonal[c])) for c in recording.names}
    shown = [c for c in recording.names if rows[c]]
    result = {("all", "pa"): ratio(int(diagonal.sum()), int(table.sum())),
              ("all", "mpa"): mean([accuracy[c] for c in shown]), ("all", "miou"): mean([iou[c] for c in shown])}
    for c, name in recording.names.items():
        result[name, "accuracy"], result[name, "iou"] = accuracy[c], iou[c]
        for d, other in recording.names.items():
            if table[c, d]:
                result[name, f"taken_for:{other}"] = int(table[c, d])
    return result
