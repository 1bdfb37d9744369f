# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Scores of instances by docs/metrics.md: predicted objects against visible ones, PQ and AP."""

from fractions import Fraction

import numpy as np
from scipy.ndimage import label as pieces_of

from map_scores import mean, ratio
from truth import unpack

LEAST_IOUS = [Fraction(n, 100) for n in range(50, 100, 5)]


def connected(keys):
    """The 26-connected pieces of a set of voxels."""
    if len(keys) == 0:
        return []
    indices = unpack(keys)
    corner = indices.min(axis=0)
    grid = np.zeros(indices.max(axis=0) - corner + 1, bool)
    grid[tuple((indices - corner).T)] = True
    numbers = pieces_of(grid, np.ones((3, 3, 3)))[0][tuple((indices - corner).T)]
    return [keys[numbers == n] for n in np.unique(numbers)]


def predicted_objects(voxels, truth, threshold):
    """[(class, keys, score in thousandths)] of detected classes, in the order of their least keys."""
    chosen = np.any([voxels.predicted(label, threshold) for label in truth.names], axis=0)
    keys, labels = voxels.keys[chosen], voxels.labels[chosen]
    billionths = np.rint(voxels.p[chosen] * 1e9).astype(np.int64)
    if voxels.instances is None:
        objects = [(label, piece) for label in np.unique(labels) for piece in connected(keys[labels == label])]
    else:
        numbers = voxels.instances[chosen]
        objects = [(int(np.bincount(labels[numbers == n]).argmax()), keys[numbers == n])
                   for n in np.unique(numbers) if n > 0]
    result = []
    for label, mine in sorted(objects, key=lambda entry: entry[1][0]):
        if label in truth.detected:
            score = int(billionths[np.isin(keys, mine)].sum()) // (len(mine) * 1_000_000)
            result.append((int(label), mine, score))
    return result


def class_matches(objects, truth, label):
    """Predictions of a class as (score, voxels, {instance: IoU}), void ones left out; and its visible instances."""
    instances = [i for i, seen in truth.instance_visible.items() if truth.class_of[i] == label and len(seen)]
    rows = []
    for of, keys, score in objects:
        if of != label:
            continue
        ious = {}
        for i in sorted(instances):
            seen, surface = truth.instance_visible[i], truth.instance_surface[i]
            shared = int(np.isin(seen, keys).sum())
            if shared:
                ious[i] = Fraction(shared, len(seen) + int((~np.isin(keys, surface)).sum()))
        if ious or 2 * np.isin(keys, truth.s_of(label)).sum() < len(keys):
            rows.append((score, len(keys), ious))
    return rows, sorted(instances)


def panoptic(rows, instances):
    """Sum of IoUs in 1e-9, TP, FP, FN."""
    pairs = sorted((-iou, i, n) for n, (_, _, ious) in enumerate(rows) for i, iou in ious.items() if 2 * iou > 1)
    taken, used, total = set(), set(), 0
    for negative, i, n in pairs:
        if i not in taken and n not in used:
            taken.add(i)
            used.add(n)
            total += int(np.floor(-negative * 10**9 + Fraction(1, 2)))
    return np.array([total, len(taken), len(rows) - len(taken), len(instances) - len(taken)])


def panoptic_figures(sums):
    total, tp, fp, fn = map(int, sums)
    return {"pq": ratio(total / 1e9, tp + fp / 2 + fn / 2), "sq": ratio(total / 1e9, tp),
            "rq": ratio(tp, tp + fp / 2 + fn / 2)}


def hits(rows, least):
    """(score, whether it takes an instance) of each prediction."""
    order = sorted(range(len(rows)), key=lambda n: (-rows[n][0], -rows[n][1], n))
    free, result = {i for _, _, ious in rows for i in ious}, []
    for n in order:
        score, _, ious = rows[n]
        choice = min((i for i in ious if i in free and ious[i] >= least), key=lambda i: (-ious[i], i), default=None)
        free.discard(choice)
        result.append((score, choice is not None))
    return result


def average_precision(taken, instances):
    if not instances:
        return None
    scores, hit = np.array([row[0] for row in taken]), np.array([row[1] for row in taken], bool)
    ap, last = 0.0, 0.0
    for score in np.unique(scores)[::-1]:
        above = scores >= score
        recall = hit[above].sum() / instances
        ap += (recall - last) * hit[above].sum() / above.sum()
        last = recall
    return ap


def figures(sums, taken, instances):
    result = panoptic_figures(sums)
    for least in (Fraction(1, 4), Fraction(1, 2), Fraction(3, 4)):
        result[f"ap_{100 * least}"] = average_precision(taken[least], instances)
    result["ap_mean"] = mean([average_precision(taken[least], instances) for least in LEAST_IOUS])
    return result


def instance_scores(voxels, truth, threshold):
    objects = predicted_objects(voxels, truth, threshold)
    by_class, raw = {}, []
    for label in truth.detected:
        rows, instances = class_matches(objects, truth, label)
        taken = {least: hits(rows, least) for least in {Fraction(1, 4), *LEAST_IOUS}}
        raw.append((panoptic(rows, instances), taken, len(instances)))
        by_class[label] = figures(*raw[-1])
    result = {(truth.names[label], name): value for label, row in by_class.items() for name, value in row.items()}
    pooled = figures(sum(part[0] for part in raw), {least: sum((part[1][least] for part in raw), []) for least in raw[0][1]},
                     sum(part[2] for part in raw))
    shown = [label for label, part in zip(truth.detected, raw) if part[2]]
    for name, value in pooled.items():
        result["pooled", name] = value
        result["macro", name] = mean([by_class[label][name] for label in shown])
    return result
