# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Scores of a voxel map by docs/metrics.md: counts, tolerance, distances, the curve, confusion.

All figures come as {(class name, metric): int, float or None}, named as `mapscore score --tidy` names them; None is `-`.
"""

from dataclasses import dataclass

import numpy as np

from distances import cube_distances, surface_distances
from truth import grown

TAUS_M, LIMIT_SLACK_M = (0.01, 0.02, 0.05, 0.1), 1e-7
COUNTS = ("predicted", "true_predicted", "visible", "found", "false_near", "false_leak", "false_floating",
          "missed_mislabelled", "missed_unlabelled", "missed_unmapped", "true_predicted_t1", "found_t1", "visible_4",
          "found_4")


@dataclass
class VoxelMap:
    """Voxels by ascending key: occupied or known to be free, class (0: none), its probability, instance (0: none)."""
    keys: np.ndarray
    occupied: np.ndarray
    labels: np.ndarray
    p: np.ndarray
    instances: np.ndarray = None

    def predicted(self, label, threshold):
        return (self.occupied & (self.labels != 0) & (self.labels == label) & (self.p >= threshold))


def ratio(part, whole):
    return part / whole if whole else None


def harmonic(precision, recall, empty):
    """F1 of two ratios: undefined only where nothing is predicted and nothing visible."""
    if empty:
        return None
    precision, recall = precision or 0, recall or 0
    return 2 * precision * recall / (precision + recall) if precision + recall else 0.0


def voxel_counts(voxels, truth, label, threshold):
    mine = voxels.keys[voxels.predicted(label, threshold)]
    others = np.unique(np.concatenate([voxels.keys[voxels.predicted(other, threshold)]
                                       for other in truth.names if other != label]))
    surface, seen = truth.s_of(label), truth.v_of(label)
    true, close = np.isin(mine, surface), np.isin(mine, grown(surface))
    touched = np.isin(mine, truth.any_surface)
    unfound = ~np.isin(seen, mine)
    missed = seen[unfound]
    mislabelled, mapped = np.isin(missed, others), np.isin(missed, voxels.keys)
    values = (len(mine), true.sum(), len(seen), len(seen) - len(missed), (close & ~true).sum(), (touched & ~close).sum(),
              (~touched & ~close).sum(), mislabelled.sum(), (mapped & ~mislabelled).sum(), (~mapped).sum(), close.sum(),
              np.isin(seen, grown(mine)).sum(), *(np.isin(part, truth.well_seen).sum() for part in (seen, seen[~unfound])))
    return {name: int(value) for name, value in zip(COUNTS, values)}


def voxel_ratios(n):
    precision, recall = ratio(n["true_predicted"], n["predicted"]), ratio(n["found"], n["visible"])
    recall_4, false = ratio(n["found_4"], n["visible_4"]), n["predicted"] - n["true_predicted"]
    loose, wide = ratio(n["true_predicted_t1"], n["predicted"]), ratio(n["found_t1"], n["visible"])
    empty = n["predicted"] + n["visible"] == 0
    return {"precision": precision, "recall": recall, "f1": harmonic(precision, recall, empty),
            "iou": ratio(n["found"], n["visible"] + false), "recall_4": recall_4,
            "f1_4": harmonic(precision, recall_4, n["visible_4"] == 0),
            "iou_4": ratio(n["found_4"], n["visible_4"] + false) if n["visible_4"] else None,
            "precision_t1": loose, "recall_t1": wide, "f1_t1": harmonic(loose, wide, empty)}


def distances(voxels, truth, label, threshold):
    """Metres from predicted cubes to the surface, and from the class's samples to predicted cubes."""
    mine = voxels.keys[voxels.predicted(label, threshold)]
    samples = truth.points[truth.class_of[truth.instances] == label]
    return surface_distances(mine, truth.shapes[label], truth.voxel), cube_distances(samples, mine, truth.voxel)


def mean_and_p95(metres):
    """Mean, None with any unreached one; the least whole millimetre that 95 % do not exceed."""
    if len(metres) == 0:
        return None, None
    finite = np.sort(np.rint(metres[np.isfinite(metres)] * 1e9))
    rank = -(-95 * len(metres) // 100) - 1
    p95 = float(np.ceil(finite[rank] / 1e6)) / 1000 if rank < len(finite) else None
    return (float(finite.sum()) / len(finite) / 1e9 if len(finite) == len(metres) else None), p95


def distance_figures(accuracy, completeness):
    result = {}
    for tau in TAUS_M:
        name = f"{round(100 * tau)}cm"
        precision, recall = (ratio(int((metres <= tau + LIMIT_SLACK_M).sum()), len(metres))
                             for metres in (accuracy, completeness))
        empty = len(accuracy) + len(completeness) == 0
        result.update({f"precision_{name}": precision, f"recall_{name}": recall,
                       f"f_{name}": harmonic(precision, recall, empty)})
    result["accuracy_mean_m"], result["accuracy_p95_m"] = mean_and_p95(accuracy)
    result["completeness_mean_m"], result["completeness_p95_m"] = mean_and_p95(completeness)
    return result


def curve(voxels, truth, label):
    """(step, true, found, p) of every occupied voxel of the class."""
    of_class = voxels.predicted(label, -1)
    keys, p = voxels.keys[of_class], voxels.p[of_class]
    return np.stack([np.floor(1000 * p + 1e-9), np.isin(keys, truth.s_of(label)), np.isin(keys, truth.v_of(label)), p])


def curve_figures(points, visible):
    step, true, found, p = points
    squares, p = np.rint((p - true)**2 * 1e9) / 1e9, np.rint(p * 1e9) / 1e9
    ap, last_recall = 0.0, 0.0
    for k in np.unique(step)[::-1] if visible else ():
        above = step >= k
        recall = found[above].sum() / visible
        ap += (recall - last_recall) * true[above].sum() / above.sum()
        last_recall = recall
    bins = np.minimum(step // 100, 9)
    gaps = [abs(p[bins == n].sum() - true[bins == n].sum()) for n in range(10)]
    return {"ap": ap if visible else None, "brier": ratio(squares.sum(), len(p)), "ece": ratio(sum(gaps), len(p))}


def listed(voxels, truth):
    """Detected classes, and others that the map names."""
    named = np.unique(voxels.labels[voxels.occupied & (voxels.labels > 0)]).tolist()
    return truth.detected + [label for label in named if label not in truth.detected]


def best_thresholds(voxels, truth):
    """(class, what) -> text as --details prints it: the highest step whose F1 no other exceeds by 1e-12, and its F1."""
    curves = {label: (curve(voxels, truth, label), len(truth.v_of(label))) for label in listed(voxels, truth)}
    named = {truth.names[label]: raw for label, raw in curves.items()}
    named["pooled"] = [joined_of(parts) for parts in zip(*(curves[label] for label in truth.detected))]
    result = {}
    for name, ((step, true, found, _), visible) in named.items():
        rows = []
        for k in np.unique(step)[::-1]:
            above = step >= k
            rows.append((harmonic(true[above].mean(), ratio(found[above].sum(), visible), False), k))
        best = max((f1 for f1, _ in rows), default=None)
        chosen = next(((f1, k) for f1, k in rows if f1 >= best - 1e-12), None)
        result[name, "best threshold"] = f"{chosen[1] / 1000:.3f}" if chosen else "-"
        result[name, "F1 there"] = f"{chosen[0]:.3f}" if chosen else "-"
    return result


def pooled_and_macro(truth, groups, figures):
    """By class, of the detected classes' raw values joined, and the mean over those of them with visible voxels.

    groups: class -> arguments of `figures`, which join by + or concatenation.
    """
    rows = {label: figures(*raw) for label, raw in groups.items()}
    shown = [label for label in truth.detected if len(truth.v_of(label))]
    result = {(truth.names[label], metric): value for label, row in rows.items() for metric, value in row.items()}
    joined = [joined_of(parts) for parts in zip(*(groups[label] for label in truth.detected))]
    result.update({("pooled", metric): value for metric, value in figures(*joined).items()})
    for metric in next(iter(rows.values())):
        result["macro", metric] = mean([rows[label][metric] for label in shown])
    return result


def joined_of(parts):
    if isinstance(parts[0], dict):
        return {name: sum(part[name] for part in parts) for name in parts[0]}
    return sum(parts) if isinstance(parts[0], int) else np.concatenate(parts, axis=-1)


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def confusion(voxels, truth, threshold):
    """(row, column) -> voxels; columns are classes, `unlabelled` and `unmapped`."""
    said = dict.fromkeys(voxels.keys.tolist(), "unlabelled")
    for label, name in truth.names.items():
        said.update(dict.fromkeys(voxels.keys[voxels.predicted(label, threshold)].tolist(), name))
    table = {}
    for label, keys in truth.visible.items():
        for key in keys.tolist():
            cell = truth.names[label], said.get(key, "unmapped")
            table[cell] = table.get(cell, 0) + 1
    everything = np.concatenate(list(truth.visible.values()))
    for label, name in truth.names.items():
        mine = voxels.keys[voxels.predicted(label, threshold)]
        false = int((~np.isin(mine, truth.s_of(label)) & ~np.isin(mine, everything)).sum())
        if false:
            table["background", name] = false
    return {(row, f"taken_for:{column}"): count for (row, column), count in table.items()}


def voxel_scores(voxels, truth, threshold):
    labels = listed(voxels, truth)
    counts = {label: (voxel_counts(voxels, truth, label, threshold),) for label in labels}
    result = pooled_and_macro(truth, counts, lambda n: {**n, **voxel_ratios(n)})
    for name in COUNTS:
        del result["macro", name]
    result["macro", "mpa"], result["macro", "miou"] = result["macro", "recall"], result["macro", "iou"]
    result.update(pooled_and_macro(
        truth, {label: distances(voxels, truth, label, threshold) for label in labels}, distance_figures))
    if truth.scene:
        result.update({key: None for key in result if key[1].startswith("f_")})
    result.update(pooled_and_macro(
        truth, {label: (curve(voxels, truth, label), len(truth.v_of(label))) for label in labels}, curve_figures))
    result.update(confusion(voxels, truth, threshold))
    return result
