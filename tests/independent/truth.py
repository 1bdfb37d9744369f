# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Surface truth and visible truth on the map's lattice. Voxels are sets of packed 64-bit keys."""

import numpy as np

from convex import SLACK

OFFSET, SHIFT = 1 << 20, 21
NEIGHBOURS = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]


def pack(indices):
    shifted = np.asarray(indices, np.int64) + OFFSET
    if shifted.size and not (0 <= shifted.min() and shifted.max() < 1 << SHIFT):
        raise ValueError("a voxel lies outside of the lattice")
    return (shifted[..., 0] << 2 * SHIFT) | (shifted[..., 1] << SHIFT) | shifted[..., 2]


def unpack(keys):
    mask = (1 << SHIFT) - 1
    return np.stack([keys >> 2 * SHIFT, (keys >> SHIFT) & mask, keys & mask], axis=-1) - OFFSET


def voxels_of(points, voxel):
    return pack(np.floor(points / voxel))


def grown(keys):
    """All voxels within one voxel of the given ones."""
    indices = unpack(keys)
    return np.unique(np.concatenate([pack(indices + n) for n in NEIGHBOURS])) if len(keys) else keys


def cubes_of(keys, voxel):
    indices = unpack(keys)
    return indices * voxel, (indices + 1) * voxel


def candidates(shape, voxel, epsilon, chunk=500_000):
    """Index blocks that cover the shape's bounding box."""
    low, high = shape.bounds()
    margin = epsilon + 2 * SLACK
    first = np.floor((low - margin) / voxel).astype(int) - 1
    last = np.floor((high + margin) / voxel).astype(int) + 1
    j, k = np.meshgrid(np.arange(first[1], last[1] + 1), np.arange(first[2], last[2] + 1), indexing="ij")
    rows = np.stack([j.ravel(), k.ravel()], axis=-1)
    step = max(1, chunk // len(rows))
    for begin in range(first[0], last[0] + 1, step):
        i = np.arange(begin, min(begin + step, last[0] + 1))
        yield np.column_stack([np.repeat(i, len(rows)), np.tile(rows, (len(i), 1))])


def unburied(shape, others, low, high):
    """Which (closed, widened) cubes keep the shape's boundary: cut into 8, 64, 512 boxes until one is exposed.

    The first round takes the whole cube: where that meets no other solid all its boxes are exposed, where it lies
    inside one all are buried.
    """
    keep = np.zeros(len(low), bool)
    owner = np.arange(len(low))
    limits = [other.bounds() for other in others]
    for level in range(4):
        if level:
            middle = (low + high) / 2
            parts = [np.where(np.array(half)[None, :] == 0, (low, middle), (middle, high))
                     for half in np.ndindex(2, 2, 2)]
            low = np.concatenate([part[0] for part in parts])
            high = np.concatenate([part[1] for part in parts])
            owner = np.tile(owner, 8)
            met = shape.boundary_meets(low - SLACK, high + SLACK)
            low, high, owner = low[met], high[met], owner[met]
        meets, inside = np.zeros(len(low), bool), np.zeros(len(low), bool)
        for other, (first, last) in zip(others, limits):
            near = np.flatnonzero(((low - SLACK <= last) & (high + SLACK >= first)).all(axis=1) & ~inside)
            if len(near):
                met, buried = other.meets_and_contains(low[near] - SLACK, high[near] + SLACK)
                meets[near] |= met
                inside[near] |= buried
        keep[owner[~meets]] = True
        undecided = meets & ~inside & ~keep[owner]
        low, high, owner = low[undecided], high[undecided], owner[undecided]
    keep[owner] = True
    return keep


def surface_truth(geoms, voxel, epsilon):
    """class -> {key: touch_only}; geoms is a list of (class, shape)."""
    truth, limits = {}, [shape.bounds() for _, shape in geoms]
    for number, (label, shape) in enumerate(geoms):
        low, high = limits[number]
        others = []
        for n, (_, other) in enumerate(geoms):
            first, last = limits[n]
            reach = voxel + 2 * epsilon + 4 * SLACK
            if n != number and other.solid and ((low - reach <= last) & (high + reach >= first)).all():
                others.append(other)
        for indices in candidates(shape, voxel, epsilon):
            cube = indices * voxel - epsilon, (indices + 1) * voxel + epsilon
            met = shape.boundary_meets(cube[0] - SLACK, cube[1] + SLACK)
            cube, indices = (cube[0][met], cube[1][met]), indices[met]
            kept = indices[unburied(shape, others, *cube)]
            open_met = shape.boundary_meets(kept * voxel + SLACK, (kept + 1) * voxel - SLACK)
            rows = truth.setdefault(label, {})
            for key, touch in zip(pack(kept).tolist(), (~open_met).tolist()):
                rows[key] = rows.get(key, True) and touch
    return truth


def key_sets(truth):
    return {label: np.array(sorted(rows), np.int64) for label, rows in truth.items()}


class Samples:
    """Depth samples counted by voxel and class."""

    def __init__(self):
        self.keys, self.labels, self.counts = (np.zeros(0, np.int64) for _ in range(3))

    def add(self, keys, labels, counts=None):
        keys = np.concatenate([self.keys, keys])
        labels = np.concatenate([self.labels, labels])
        counts = np.concatenate([self.counts, np.ones(len(keys) - len(self.counts), np.int64)
                                 if counts is None else counts])
        order = np.lexsort((labels, keys))
        keys, labels, counts = keys[order], labels[order], counts[order]
        first = np.ones(len(keys), bool)
        first[1:] = (keys[1:] != keys[:-1]) | (labels[1:] != labels[:-1])
        begin = np.flatnonzero(first)
        self.keys, self.labels = keys[begin], labels[begin]
        self.counts = np.add.reduceat(counts, begin) if len(begin) else counts

    def owners(self):
        """keys, the class with most samples in each (ties to the lower id), all samples in it."""
        order = np.lexsort((self.labels, -self.counts, self.keys))
        keys, begin = np.unique(self.keys[order], return_index=True)
        total = np.add.reduceat(self.counts[order], begin) if len(keys) else self.counts
        return keys, self.labels[order][begin], total


def visible_truth(samples, surface, min_samples=1):
    """class -> {key: samples of any class}, for the voxels that the class owns and whose surface they hold."""
    visible = {label: {} for label in surface}
    for key, label, total in zip(*(column.tolist() for column in samples.owners())):
        if label != 0 and total >= min_samples and key in surface.get(label, ()):
            visible[label][key] = total
    return visible
