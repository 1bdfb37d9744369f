# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Maps of what a recording's depth and labels show, with every kind of error put in on purpose."""

import numpy as np

from free_space import free_voxels
from map_scores import VoxelMap
from truth import Samples, pack, unpack, voxels_of


def first_of_each(keys, *columns):
    kept, rows = np.unique(keys, return_index=True)
    return kept, *(column[rows] for column in columns)


def bridge(truth, label):
    """Voxels on the line between the two visible instances of a class that lie closest, to merge them."""
    seen = [unpack(keys) for i, keys in truth.instance_visible.items() if truth.class_of[i] == label and len(keys)]
    if len(seen) < 2:
        return np.zeros(0, np.int64)
    pairs = [(a[n], b[m]) for k, a in enumerate(seen) for b in seen[k + 1:]
             for n, m in [np.unravel_index(np.abs(a[:, None] - b[None]).max(axis=-1).argmin(), (len(a), len(b)))]]
    start, end = min(pairs, key=lambda pair: np.abs(pair[1] - pair[0]).max())
    steps = np.linspace(0, 1, 2 * int(np.abs(end - start).max()) + 1)
    return np.unique(pack(np.rint(start + steps[:, None] * (end - start)).astype(np.int64)))


def probabilities(random, count):
    """Any number, whole thousandths, and the limits, so that ties and thresholds are hit."""
    kind = random.integers(0, 8, count)
    return np.select([kind < 3, kind < 6, kind == 6], [random.uniform(size=count), random.integers(0, 1001, count) / 1000,
                                                       np.full(count, 0.25)], random.integers(0, 2, count).astype(float))


def damaged_map(truth, seed, merged=(), wrong=(), with_free=True):
    """The voxels that hold samples, with their owner's class, then damaged. merged: classes two of whose instances grow
    together; wrong: (instance, class) of objects that are taken for another class."""
    random = np.random.default_rng(seed)
    samples = Samples()
    samples.add(voxels_of(truth.points, truth.voxel), truth.instances)
    keys, instances, _ = samples.owners()
    labels = truth.class_of[instances]
    for instance, label in wrong:
        labels = np.where(instances == instance, label, labels)
    dice = random.uniform(size=len(keys))
    lone = np.isin(labels, truth.detected)
    labels = np.where(dice < 0.06, random.integers(0, max(truth.names) + 1, len(keys)), labels)  # also to none
    moved = np.where((0.06 < dice) & (dice < 0.14), 1, 0) + np.where((0.14 < dice) & (dice < 0.17), 4, 0)
    keys = pack(unpack(keys) + moved[:, None] * random.integers(-1, 2, (len(keys), 3)))
    kept = (dice < 0.9) | (lone & (dice < 0.95))
    keys, labels, instances = keys[kept], labels[kept], instances[kept]
    for label in merged:
        more = bridge(truth, label)
        keys = np.concatenate([more, keys])
        labels = np.concatenate([np.full(len(more), label), labels])
        instances = np.concatenate([np.zeros(len(more), np.int64), instances])
    hidden = np.setdiff1d(np.concatenate([truth.s_of(label) for label in truth.detected]), keys)
    hidden = random.choice(hidden, len(hidden) // 9, replace=False)  # true, but never seen
    owner = np.zeros(len(hidden), np.int64)
    for label in truth.detected:
        owner[np.isin(hidden, truth.s_of(label))] = label
    keys, labels, instances = (np.concatenate(pair) for pair in ((keys, hidden), (labels, owner),
                                                                 (instances, np.zeros(len(hidden), np.int64))))
    keys, labels, instances = first_of_each(keys, labels, instances)
    occupied = np.ones(len(keys), bool)
    if with_free:
        free = free_voxels(truth)
        free = free[(unpack(free)[:, 2] % 16 < 13) & (random.uniform(size=len(free)) < 0.97)]
        free = np.concatenate([free, truth.any_surface[random.uniform(size=len(truth.any_surface)) < 0.03],
                               truth.sampled_voxels()[::41]])
        free = np.setdiff1d(free, keys[random.uniform(size=len(keys)) < 0.98])
        stays = ~np.isin(keys, free)
        keys, labels, instances = (np.concatenate(pair) for pair in (
            (keys[stays], free), (labels[stays], np.zeros(len(free), np.int64)),
            (instances[stays], np.zeros(len(free), np.int64))))
        occupied = np.concatenate([np.ones(stays.sum(), bool), np.zeros(len(free), bool)])
    keys, labels, instances, occupied = first_of_each(keys, labels, instances, occupied)
    p = np.where(labels > 0, probabilities(random, len(keys)), 0)
    return VoxelMap(keys, occupied, labels, p, numbered(random, keys, instances, labels))


def numbered(random, keys, instances, labels):
    """Object numbers of a mapper: other than the truth's, some objects split, two joined, some voxels astray."""
    numbers = np.where(instances > 0, 7 * instances + 2, 0)
    half = unpack(keys)[:, 0] > np.median(unpack(keys)[:, 0])
    first = np.unique(instances)[1:3]
    numbers = np.where(np.isin(instances, first), numbers.max(initial=0) + 3, numbers)
    numbers = np.where((instances % 5 == 3) & half, numbers + 1, numbers)
    astray = random.uniform(size=len(keys)) < 0.04
    return np.where(astray, random.integers(0, 60, len(keys)), numbers) * (labels > 0)


def without_free(voxels):
    kept = voxels.occupied
    return VoxelMap(voxels.keys[kept], voxels.occupied[kept], voxels.labels[kept], voxels.p[kept], voxels.instances[kept])
