# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Registration of depth to colour and the three 3D segmentations of docs/methods.md, as plainly as possible."""

import itertools

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from recording import moved


def cross_product(vector):
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def exponential(vector):
    """Rotation matrix of a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    cross = cross_product(np.asarray(vector, float) / angle)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def register(recording, points, believed):
    """For each colour pixel the index of the depth pixel that it shows, or -1."""
    color, depth = recording.color, recording.depth
    used = np.flatnonzero(points[:, 2] > 0)
    seen = moved(believed, points[used])
    front = seen[:, 2] > 0
    used, seen = used[front], seen[front]
    centre, reach = [], []
    for axis, f, c in ((0, "fx_px", "cx_px"), (1, "fy_px", "cy_px")):
        centre.append(color[f] * seen[:, axis] / seen[:, 2] + color[c])
        scale = color[f] / depth[f] * (points[used, 2] / seen[:, 2])
        reach.append(np.maximum(1.0, scale) / 2)
    first = [np.ceil(at - h).astype(np.int64) - 1 for at, h in zip(centre, reach)]
    spans = [range(int(np.ceil(2 * h.max())) + 3) if len(h) else range(0) for h in reach]
    pixels, sources, nearness = [], [], []
    for du, dv in itertools.product(*spans):
        u, v = first[0] + du, first[1] + dv
        hit = (np.abs(u - centre[0]) <= reach[0]) & (np.abs(v - centre[1]) <= reach[1])
        hit &= (0 <= u) & (u < color["width_px"]) & (0 <= v) & (v < color["height_px"])
        pixels.append(v[hit] * color["width_px"] + u[hit])
        sources.append(used[hit])
        nearness.append(seen[hit, 2])
    result = np.full(color["width_px"] * color["height_px"], -1)
    if pixels:
        pixels, sources, nearness = (np.concatenate(part) for part in (pixels, sources, nearness))
        order = np.lexsort((sources, nearness, pixels))  # nearest first, then lower row and column of the depth pixel
        winners = order[np.unique(pixels[order], return_index=True)[1]]
        result[pixels[winners]] = sources[winners]
    return result.reshape(color["height_px"], color["width_px"])


def tight_box(mask):
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return columns[0], columns[-1], rows[0], rows[-1]


def eroded(mask, radius):
    """Pixels with no pixel outside the mask, inside the image, within the disc."""
    if mask.all():
        return mask
    u0, u1, v0, v1 = tight_box(mask)
    margin = int(radius) + 2
    rows, columns = slice(max(0, v0 - margin), v1 + margin + 1), slice(max(0, u0 - margin), u1 + margin + 1)
    result = np.zeros_like(mask)
    if mask[rows, columns].all():
        return mask
    squared = np.rint(distance_transform_edt(mask[rows, columns])**2)
    result[rows, columns] = mask[rows, columns] & (squared > radius**2)
    return result


def grow_region(points, seed, pitch, radius):
    """Accepted lattice positions (M, 3) and which points are kept."""
    base = np.rint((points - seed) / pitch).astype(np.int64)
    owners, places = [], []
    for offset in itertools.product((-1, 0, 1), repeat=3):  # radius <= pitch: no other position is near enough
        place = base + offset
        near = ((points - (seed + place * pitch))**2).sum(axis=1) < radius**2
        owners.append(np.flatnonzero(near))
        places.append(place[near])
    owners, places = np.concatenate(owners), np.concatenate(places)
    kept = np.zeros(len(points), bool)
    positions, which = np.unique(places, axis=0, return_inverse=True)
    start = np.flatnonzero((positions == 0).all(axis=1))
    if len(start) == 0:
        return np.zeros((0, 3), np.int64), kept
    pairs = cKDTree(positions).query_pairs(1.5, p=np.inf, output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(positions),) * 2)
    piece = connected_components(graph, directed=False)[1]
    accepted = piece == piece[start[0]]
    kept[owners[accepted[which.reshape(-1)]]] = True
    return positions[accepted], kept


def sensor_voxel_centres(points, pitch):
    return (np.unique(np.floor(points / pitch), axis=0) + 0.5) * pitch


def segment(mask, registered, cloud, options):
    """Points that one detection keeps, and what it adds to the observation, both in depth_optical."""
    if options.method == "erosion":
        mask = eroded(mask, options.radius_px)
    sources = registered[mask]
    points = cloud[sources[sources >= 0]]
    if options.method == "region_growing":
        u0, u1, v0, v1 = tight_box(mask)
        source = registered[(v0 + v1) // 2, (u0 + u1) // 2]
        if source < 0 or len(points) == 0:
            return np.zeros((0, 3)), np.zeros((0, 3))
        seed = cloud[source]
        positions, kept = grow_region(points, seed, options.voxel_m, options.radius_factor * options.voxel_m)
        return points[kept], points[kept] if options.place == "points" else seed + positions * options.voxel_m
    return points, points if options.place == "points" else sensor_voxel_centres(points, options.voxel_m)


def observe_depth_labels(recording, frame, options):
    """What the lattice ceiling is given: points in depth_optical, their classes and scores, and no detections."""
    _, depth_path, depth_label_path, _ = frame
    cloud = recording.cloud(recording.read_depth(depth_path))
    classes = recording.classes_of(recording.read_image(depth_label_path)).reshape(-1)
    points, found = [np.zeros((0, 3))], [np.zeros(0, np.int64)]
    for label in sorted(recording.detected):
        kept = cloud[(classes == label) & (cloud[:, 2] > 0)]
        points.append(sensor_voxel_centres(kept, options.voxel_m) if options.place == "voxels" else kept)
        found.append(np.full(len(points[-1]), label))
    found = np.concatenate(found)
    return np.concatenate(points), found, np.ones(len(found)), []


def observe(recording, sight, options, believed):
    """Points in depth_optical, classes and scores of one frame, and its detections as (instance, points kept)."""
    cloud = recording.cloud(sight.z)
    registered = register(recording, cloud, believed)
    points, found, scores, detections = [np.zeros((0, 3))], [np.zeros(0, np.int64)], [np.zeros(0)], []
    for instance, (label, score) in sight.detections.items():
        kept, placed = segment(sight.labels == instance, registered, cloud, options)
        detections.append((instance, kept))
        points.append(placed)
        found.append(np.full(len(placed), label))
        scores.append(np.full(len(placed), score))
    return np.concatenate(points), np.concatenate(found), np.concatenate(scores), detections
