# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Scores of label images: mean pixel accuracy, mean intersection over union ([R], equations 11 and 12).

Background is left out of the means, and so are classes that the frames do not have.
"""

import dataclasses
import math

import numpy as np
import torch
from scipy import stats

from data import UNITS_PER_M


def images_of(frames, part, channels):
    """Frames as the networks take them, without augmentation: (n, channels, H, W)."""
    image = frames.color[part].astype(np.float32)
    if channels == 4:
        depth = frames.depth[part].astype(np.float32) / UNITS_PER_M
        image = np.concatenate([image, depth[..., None]], 3)
    return np.ascontiguousarray(image.transpose(0, 3, 1, 2))


def confusion(net, frames, channels, classes, batch=8):
    """Pixels by true class (row) and by the network's (column)."""
    counts = np.zeros((classes, classes), np.int64)
    with torch.no_grad():
        for n in range(0, len(frames), batch):
            part = slice(n, n + batch)
            said = net(torch.from_numpy(images_of(frames, part, channels))).argmax(1).numpy()
            pairs = frames.label[part].astype(np.int64) * classes + said
            counts += np.bincount(pairs.ravel(), minlength=classes**2).reshape(classes, classes)
    return counts


@dataclasses.dataclass(frozen=True)
class Scores:
    mpa: float
    miou: float
    pixel_accuracy: float
    iou: dict        # by class, those of the frames
    accuracy: dict


def scores(counts, names):
    """Of a confusion matrix; `names` of its channels, the first background. Shares from 0 to 1."""
    true, said, right = counts.sum(1), counts.sum(0), counts.diagonal()
    there = [n for n in range(1, len(names)) if true[n]]
    accuracy = {names[n]: right[n] / true[n] for n in there}
    iou = {names[n]: right[n] / (true[n] + said[n] - right[n]) for n in there}
    return Scores(float(np.mean(list(accuracy.values()))), float(np.mean(list(iou.values()))),
                  float(right[1:].sum() / true[1:].sum()), iou, accuracy)


def interval(values, level=0.95):
    """Mean and half-width of Student's interval over seeds; infinite of one."""
    mean, n = float(np.mean(values)), len(values)
    if n < 2:
        return mean, math.inf
    return mean, float(stats.t.ppf((1 + level) / 2, n - 1) * np.std(values, ddof=1) / math.sqrt(n))


def with_interval(values):
    """`mean +- half-width` in percent."""
    mean, half = interval(values)
    return f"{100 * mean:.1f}" if math.isinf(half) else f"{100 * mean:.1f} +- {100 * half:.1f}"
