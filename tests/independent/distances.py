# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Distances between points, closed voxels and the boundaries of shapes."""

import numpy as np
from scipy.spatial import cKDTree

from convex import SLACK, distance_to_boxes
from truth import cubes_of, voxels_of


def cube_distances(points, keys, voxel):
    """Distance from each point to the nearest of the closed cubes. The cube with the nearest centre need not be the
    nearest cube, so more centres are asked for until none farther away can win."""
    best = np.full(len(points), np.inf)
    if len(keys) == 0 or len(points) == 0:
        return best
    best[np.isin(voxels_of(points, voxel), keys)] = 0
    low, high = cubes_of(keys, voxel)
    tree = cKDTree((low + high) / 2)
    open_ = np.flatnonzero(best > 0)
    count = 8
    while len(open_):
        count = min(count, len(keys))
        rest = []
        for part in np.array_split(open_, len(open_) // 100_000 + 1):
            centre, nearest = tree.query(points[part], k=count)
            centre, nearest = centre.reshape(len(part), -1), nearest.reshape(len(part), -1)
            distance = distance_to_boxes(points[part][:, None], low[nearest], high[nearest]).min(axis=1)
            best[part] = distance
            if count < len(keys):
                rest.append(part[centre[:, -1] - voxel * np.sqrt(3) / 2 <= distance])
        open_ = np.concatenate(rest) if rest else []
        count *= 4
    return best


class KeptDistances:
    """surface_distances() that measures a cube once for the same shapes, since the maps of a drive share most cubes."""

    def __init__(self):
        self.known = {}

    def __call__(self, keys, shapes, voxel):
        known = self.known.setdefault((bounds_of(shapes), voxel), {})
        new = np.array([key for key in keys.tolist() if key not in known], np.int64)
        known.update(zip(new.tolist(), surface_distances(new, shapes, voxel)))
        return np.array([known[key] for key in keys.tolist()])


def bounds_of(shapes):
    """Tells shapes, and their order, from others."""
    return np.array([shape.bounds() for shape in shapes]).tobytes()


def surface_distances(keys, shapes, voxel):
    """Distance from each closed cube to the nearest boundary of the shapes."""
    best = np.full(len(keys), np.inf)
    low, high = cubes_of(keys, voxel)
    for shape in shapes:  # touching ones first: they are cheap and rule out most of the rest
        best[shape.boundary_meets(low - SLACK, high + SLACK)] = 0
    for shape in shapes:
        first, last = shape.bounds()
        gap = np.linalg.norm(np.maximum(0, np.maximum(first - high, low - last)), axis=1)
        todo = np.flatnonzero(gap < best)
        best[todo] = np.minimum(best[todo], shape.boundary_distance(low[todo], high[todo]))
    return best
