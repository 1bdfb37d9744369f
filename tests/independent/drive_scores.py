# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Scores of a drive's maps, as raw values by kind of figure and detected class: those of several maps join.

Raw values of one map: kind -> class -> arguments of the function in FIGURES that makes the figures of that kind.
"""

from dataclasses import dataclass

import numpy as np

from boxes import box_figures
from distances import cube_distances, surface_distances
from map_scores import COUNTS, curve, curve_figures, distance_figures, joined_of, pooled_and_macro, voxel_ratios
from convex import SLACK
from truth import grown, key_sets

TAUS_CM = (1, 2, 5, 10)
WELL_SEEN = 4  # samples from which on a voxel of V counts for recall_4
EMPTY = np.zeros(0, np.int64)


def voxel_figures(counts):
    return {**counts, **voxel_ratios(counts)}


def counts_within(accuracy, completeness):
    """How many cubes and samples lie within each limit: what the shares are made of."""
    result = {"samples": len(completeness)}
    for name, metres in (("precise", accuracy), ("complete", completeness)):
        result.update({f"{name}_{tau}cm": int((metres <= tau / 100 + SLACK).sum()) for tau in TAUS_CM})
    return result


FIGURES = {"voxels": voxel_figures, "distances": distance_figures, "curve": curve_figures, "boxes": box_figures}
MACRO_RATIOS = {"mpa": "recall", "miou": "iou"}


@dataclass
class Seen:
    """The truth that one map, or several, are held against: class -> ascending keys."""
    names: dict
    detected: list
    surface: dict
    visible: dict

    def s_of(self, label):
        return self.surface.get(label, EMPTY)

    def v_of(self, label):
        return self.visible.get(label, EMPTY)


class DriveScores:
    """Scores of maps on one lattice against its surfaces."""

    def __init__(self, recording, geoms, surface, voxel):
        self.names, self.detected, self.voxel = recording.names, sorted(recording.detected), voxel
        self.labels = sorted(label for label in recording.names if label != 0)
        self.surface = key_sets(surface)
        self.shapes = {label: [shape for owner, shape in geoms if owner == label] for label in self.labels}
        self.near = {label: grown(keys) for label, keys in self.surface.items() if label in self.detected}
        self.others = {label: np.unique(np.concatenate([EMPTY] + [keys for other, keys in self.surface.items()
                                                                  if other != label])) for label in self.detected}

    def of_map(self, voxels, threshold, visible, samples, sample_classes, boxes):
        """Raw values of a map against what its frames saw: visible as class -> {key: samples}, boxes as box_ious."""
        seen = {label: np.array(sorted(visible.get(label, ())), np.int64) for label in self.detected}
        well_seen = {label: np.array([key for key, count in visible.get(label, {}).items() if count >= WELL_SEEN],
                                     np.int64) for label in self.detected}
        truth = Seen(self.names, self.detected, self.surface, seen)
        predicted = {label: voxels.keys[voxels.predicted(label, threshold)] for label in self.labels}
        result = {kind: {} for kind in FIGURES}
        for label in self.detected:
            mine = predicted[label]
            result["voxels"][label] = self.counts(label, predicted, voxels.keys, seen[label], well_seen[label]),
            result["distances"][label] = (surface_distances(mine, self.shapes[label], self.voxel),
                                          cube_distances(samples[sample_classes == label], mine, self.voxel))
            result["curve"][label] = curve(voxels, truth, label), len(seen[label])
            result["boxes"][label] = boxes[label]
        return result

    def counts(self, label, predicted, mapped, seen, well_seen):
        mine, surface = predicted[label], self.surface.get(label, EMPTY)
        on_surface, close = np.isin(mine, surface), np.isin(mine, self.near.get(label, EMPTY))
        on_other = np.isin(mine, self.others[label])
        found = np.isin(seen, mine)
        missed = seen[~found]
        elsewhere = np.isin(missed, np.concatenate([EMPTY] + [keys for other, keys in predicted.items()
                                                              if other != label]))
        in_map = np.isin(missed, mapped)
        values = (len(mine), on_surface.sum(), len(seen), found.sum(), (~on_surface & close).sum(),
                  (~on_surface & ~close & on_other).sum(), (~on_surface & ~close & ~on_other).sum(), elsewhere.sum(),
                  (in_map & ~elsewhere).sum(), (~in_map).sum(), close.sum(), np.isin(seen, grown(mine)).sum(),
                  len(well_seen), np.isin(well_seen, mine).sum())
        return {name: int(value) for name, value in zip(COUNTS, values)}

    def joined(self, maps, kind):
        return {label: tuple(joined_of(parts) for parts in zip(*(one[kind][label] for one in maps)))
                for label in self.detected}

    def figures(self, maps):
        """(class name, metric) -> int, float or None, of the raw values of all maps together."""
        visible = {label: range(sum(one["curve"][label][1] for one in maps)) for label in self.detected}
        whole, result = Seen(self.names, self.detected, {}, visible), {}
        for kind, figures_of in FIGURES.items():
            result.update(pooled_and_macro(whole, self.joined(maps, kind), figures_of))
        counts = [metric for (group, metric), value in result.items() if group == "pooled" and isinstance(value, int)]
        for metric in counts:  # which have no mean
            del result["macro", metric]
        result.update({("macro", name): result["macro", of] for name, of in MACRO_RATIOS.items()})
        return result

    def own_counts(self, maps):
        """(class name, metric) -> int, which the program keeps to itself."""
        return {(self.names[label], metric): count for label, raw in self.joined(maps, "distances").items()
                for metric, count in counts_within(*raw).items()}
