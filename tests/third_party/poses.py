# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Chooses where a hand-held camera looks at a scene from, by the voxels of its truth."""

import numpy as np

NEAREST_M, FARTHEST_M = 0.8, 3.5  # of the eye from what it looks at; the camera sees from 0.6 m on
CLEARANCE_M = 0.12
ELEVATION_DEG = (8, 65)
TRIES = 240


def cells(points, edge_m):
    return set(map(tuple, np.unique(np.floor(points / edge_m).astype(int), axis=0).tolist()))


class Solid:
    """Voxels that are not free, for walks along rays."""

    def __init__(self, centres, edge_m):
        self.edge_m = edge_m
        self.keys = cells(centres, edge_m)
        self.coarse = cells(centres, CLEARANCE_M)

    def holds(self, point):
        return tuple(np.floor(point / self.edge_m).astype(int)) in self.keys

    def near(self, point):
        x, y, z = np.floor(point / CLEARANCE_M).astype(int)
        return any((x + i, y + j, z + k) in self.coarse
                   for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1))

    def reaches(self, eye, target):
        """True when the first voxel on the way lies near the target."""
        way = target - eye
        length = np.linalg.norm(way)
        for distance in np.arange(0, length - 3 * self.edge_m, 0.5 * self.edge_m):
            if self.holds(eye + way * (distance / length)):
                return False
        return True


def spread(points, count, random):
    """Points far from each other: each the farthest from those before it."""
    chosen = [points[random.integers(len(points))]]
    distance = np.full(len(points), np.inf)
    for _ in range(count - 1):
        distance = np.minimum(distance, np.linalg.norm(points - chosen[-1], axis=1))
        chosen.append(points[int(np.argmax(distance))])
    return chosen


def eye_for(target, solid, reach_m, random):
    best, best_score = None, -np.inf
    for _ in range(TRIES):
        azimuth = random.uniform(0, 2 * np.pi)
        elevation = np.radians(random.uniform(*ELEVATION_DEG))
        distance = random.uniform(NEAREST_M, reach_m)
        eye = target + distance * np.array([np.cos(azimuth) * np.cos(elevation),
                                            np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
        if solid.near(eye):
            continue
        score = distance + (10 if solid.reaches(eye, target) else 0)
        if score > best_score:
            best, best_score = eye, score
    return target + [NEAREST_M, 0, NEAREST_M] if best is None else best


def quaternion(rotation):
    """x y z w of a rotation matrix."""
    from_trace = np.array([1 + rotation[0, 0] - rotation[1, 1] - rotation[2, 2],
                           1 - rotation[0, 0] + rotation[1, 1] - rotation[2, 2],
                           1 - rotation[0, 0] - rotation[1, 1] + rotation[2, 2],
                           1 + np.trace(rotation)])
    largest = int(np.argmax(from_trace))
    sums, differences = rotation + rotation.T, rotation - rotation.T
    q = np.array([[from_trace[0], sums[0, 1], sums[0, 2], differences[2, 1]],
                  [sums[0, 1], from_trace[1], sums[1, 2], differences[0, 2]],
                  [sums[0, 2], sums[1, 2], from_trace[2], differences[1, 0]],
                  [differences[2, 1], differences[0, 2], differences[1, 0], from_trace[3]]])[largest]
    return q / np.linalg.norm(q)


def looking(eye, target):
    """Rotation of an optical frame (x right, y down, z forward), upright."""
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(forward, right), forward])


def trajectory(centres, edge_m, count, seed=1):
    """TUM lines of `count` poses that look at surfaces spread over the voxels (N x 3, metres)."""
    random = np.random.default_rng(seed)
    solid = Solid(centres, edge_m)
    size = float(np.linalg.norm(centres.max(axis=0) - centres.min(axis=0)))
    reach_m = float(np.clip(0.7 * size, NEAREST_M + 0.2, FARTHEST_M))
    lines = ["# stamp_s tx ty tz qx qy qz qw"]
    for index, target in enumerate(spread(centres, count, random)):
        eye = eye_for(target, solid, reach_m, random)
        values = [0.1 * index, *eye, *quaternion(looking(eye, target))]
        lines.append(" ".join(f"{value:.9f}" for value in values))
    return "\n".join(lines) + "\n"
