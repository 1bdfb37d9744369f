# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Free, occupied and unknown voxels by docs/metrics.md, from the depth images of a recording."""

import itertools

import numpy as np

from map_scores import ratio
from recording import moved
from truth import pack


def in_view(recording, T_map_depth, depth, edge, indices, behind=0):
    """Whether each voxel's centre is in view of the depth image and at most so many metres behind what it shows."""
    camera = recording.depth
    gap = (indices + 0.5) * edge - T_map_depth[:3, 3]
    R = T_map_depth[:3, :3]
    x, y, z = (R[0, n] * gap[:, 0] + R[1, n] * gap[:, 1] + R[2, n] * gap[:, 2] for n in range(3))
    ahead = np.flatnonzero((z >= camera["range_min_m"]) & (z <= camera["range_max_m"]))
    x, y, z = x[ahead], y[ahead], z[ahead]
    u = np.floor(camera["fx_px"] * x / z + camera["cx_px"] + 0.5).astype(np.int64)
    v = np.floor(camera["fy_px"] * y / z + camera["cy_px"] + 0.5).astype(np.int64)
    inside = (u >= 0) & (u < camera["width_px"]) & (v >= 0) & (v < camera["height_px"])
    shown = np.zeros(len(z))
    shown[inside] = depth[v[inside], u[inside]]
    result = np.zeros(len(indices), bool)
    result[ahead] = (shown != 0) & (z <= shown + behind)
    return result


def voxels_around(recording, T_map_depth, depth, edge):
    """Indices of a box that holds the pyramids of all pixels, in slabs."""
    camera = recording.depth
    v, u = np.indices(depth.shape)
    corners = [np.zeros((1, 3))]
    for du, dv in itertools.product((-0.51, 0.51), repeat=2):
        x, y = (u + du - camera["cx_px"]) / camera["fx_px"], (v + dv - camera["cy_px"]) / camera["fy_px"]
        corners.append(np.stack([x * depth, y * depth, depth], axis=-1).reshape(-1, 3))
    corners = moved(T_map_depth, np.concatenate(corners))
    first, last = (np.floor(bound / edge).astype(int) for bound in (corners.min(axis=0) - edge, corners.max(axis=0) + edge))
    for i in range(first[0], last[0] + 1):
        yield np.stack(np.meshgrid([i], *(np.arange(first[n], last[n] + 1) for n in (1, 2)), indexing="ij"),
                       axis=-1).reshape(-1, 3)


def free_voxels(truth):
    recording, found = truth.lattice.recording, [np.zeros(0, np.int64)]
    for frame in truth.frames:
        depth = recording.read_image(frame[1]) / 5000.0
        T_map_depth = truth.lattice.T_map_world @ frame[3] @ recording.T_base_depth
        for indices in voxels_around(recording, T_map_depth, depth, truth.voxel):
            found.append(pack(indices[in_view(recording, T_map_depth, depth, truth.voxel, indices)]))
    free = np.unique(np.concatenate(found))
    return free[~np.isin(free, truth.any_surface) & ~np.isin(free, truth.sampled_voxels())]


def free_space_scores(voxels, truth):
    """The figures, and the table of --details: rows truly occupied and free, columns occupied, free, not in the map."""
    occupied, free = truth.sampled_voxels(), free_voxels(truth)
    as_free = voxels.keys[~voxels.occupied]
    table = [[int(np.isin(true, voxels.keys[voxels.occupied]).sum()), int(np.isin(true, as_free).sum()),
              int((~np.isin(true, voxels.keys)).sum())] for true in (occupied, free)]
    judged = np.isin(as_free, np.concatenate([occupied, free, truth.any_surface]))
    known = len(occupied) + len(free)
    return {("all", "occupied_recall"): ratio(table[0][0], len(occupied)),
            ("all", "free_recall"): ratio(table[1][1], len(free)),
            ("all", "free_precision"): ratio(table[1][1], int(judged.sum())),
            ("all", "unknown_share"): ratio(table[0][2] + table[1][2], known)}, table
