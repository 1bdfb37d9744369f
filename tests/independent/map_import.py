# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Points and voxels of a file onto the truth's lattice, by docs/formats.md."""

import numpy as np

from map_scores import VoxelMap
from recording import moved
from truth import pack, unpack, voxels_of

FACE_SLACK_M = 1e-9


def voted(keys, labels, p, instances):
    """One voxel of all that fall into it: class of most, ties to the lower; of that class's, mean p and most instances."""
    rows = []
    order = np.argsort(keys, kind="stable")
    for part in np.split(order, np.flatnonzero(np.diff(keys[order])) + 1):
        label = np.bincount(labels[part]).argmax()
        winners = part[labels[part] == label]
        rows.append((keys[part[0]], label, p[winners].mean(), np.bincount(instances[winners]).argmax()))
    keys, labels, p, instances = (np.array(column) for column in zip(*rows))
    return keys, labels, p, instances


def binned(points, labels, p, instances, voxel):
    keys, labels, p, instances = voted(voxels_of(points, voxel), labels, p, instances)
    return VoxelMap(keys, np.ones(len(keys), bool), labels, p, instances)


def on_face(points, voxel):
    return pack(np.floor((points + FACE_SLACK_M) / voxel))


def pushed(voxels, edge, T_map_file, voxel):
    """Finer voxels: their centres vote, occupied ones before free ones."""
    keys = on_face(moved(T_map_file, (unpack(voxels.keys) + 0.5) * edge), voxel)
    solid = voxels.occupied
    result = VoxelMap(None, None, None, None)
    result.keys, result.labels, result.p, result.instances = voted(
        keys[solid], voxels.labels[solid], voxels.p[solid], voxels.instances[solid])
    free = np.setdiff1d(keys[~solid], result.keys)
    return joined(result, free)


def joined(solid, free):
    order = np.argsort(np.concatenate([solid.keys, free]))
    none = np.zeros(len(free), np.int64)
    return VoxelMap(np.concatenate([solid.keys, free])[order], np.repeat([True, False], [len(solid.keys), len(free)])[order],
                    *(np.concatenate([column, none])[order] for column in (solid.labels, solid.p, solid.instances)))


def pulled(voxels, edge, T_map_file, voxel):
    """Coarser or moved voxels: each voxel of the lattice takes what holds its centre."""
    corners = moved(T_map_file, np.concatenate([(unpack(voxels.keys) + shift) * edge for shift in np.ndindex(2, 2, 2)]))
    first, last = (np.floor(bound / voxel).astype(int) for bound in (corners.min(axis=0) - voxel, corners.max(axis=0) + voxel))
    T_file_map, keys, rows = np.linalg.inv(T_map_file), [], []
    for i in range(first[0], last[0] + 1):
        slab = np.stack(np.meshgrid([i], *(np.arange(first[n], last[n] + 1) for n in (1, 2)), indexing="ij"),
                        axis=-1).reshape(-1, 3)
        held = on_face(moved(T_file_map, (slab + 0.5) * voxel), edge)
        at = np.minimum(np.searchsorted(voxels.keys, held), len(voxels.keys) - 1)
        hit = voxels.keys[at] == held
        keys.append(pack(slab[hit]))
        rows.append(at[hit])
    keys, rows = np.concatenate(keys), np.concatenate(rows)
    return VoxelMap(keys, voxels.occupied[rows], voxels.labels[rows], voxels.p[rows], voxels.instances[rows])
