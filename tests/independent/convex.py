# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Exact relations between axis-aligned cubes and convex primitives, all in frame `map`.

Every solid is convex and closed. A closed cube meets the boundary of a solid exactly if it meets the solid and does
not lie in its open interior, and it lies in the open interior exactly if its eight corners do. So each shape needs:
`meets` (closed cube against closed solid), `nearest` (projection of outside points), `depth` (distance of inside
points to the boundary) and `support` (farthest point in a direction). No separating axes are used anywhere.
"""

import itertools

import numpy as np

SLACK = 1e-9  # metres: contact in exact arithmetic counts as contact in doubles

CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))  # 0 = low, 1 = high
EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if np.abs(CORNERS[a] - CORNERS[b]).sum() == 1]
FIRST, LAST = np.transpose(EDGES)  # corners at the two ends of the twelve edges


def rotation_of_quaternion(quaternion):
    """Rotation matrix of a quaternion in the order x y z w."""
    x, y, z, w = np.asarray(quaternion, float) / np.linalg.norm(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def corners_of(low, high):
    """(N, 8, 3) corners of N cubes."""
    return np.where(CORNERS[None] == 0, low[:, None], high[:, None])


def clip_line(first, last, start, step, low, high):
    """Narrow [first, last] to the parameters t for which low <= start + t * step <= high (all broadcast)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (low - start) / step, (high - start) / step
    parallel = step == 0
    outside = parallel & ((start < low) | (start > high))
    first = np.where(parallel, np.where(outside, np.inf, first), np.maximum(first, np.minimum(a, b)))
    last = np.where(parallel, last, np.minimum(last, np.maximum(a, b)))
    return first, last


def segment_meets_box(start, end, low, high):
    """Whether closed segments meet closed axis-aligned boxes (arrays (..., 3) that broadcast)."""
    first, last = np.zeros(()), np.ones(())
    for axis in range(3):
        first, last = clip_line(first, last, start[..., axis], end[..., axis] - start[..., axis],
                                low[..., axis], high[..., axis])
    return first <= last


def distance_to_boxes(points, low, high):
    return np.linalg.norm(points - np.clip(points, low, high), axis=-1)


class Shape:
    """A convex primitive with a pose. Points are (..., 3) arrays; sub-classes work in the local frame."""

    solid = True

    def __init__(self, rotation, centre, size):
        self.rotation, self.centre, self.size = rotation, centre, np.asarray(size, float)

    def local(self, points):
        return ((points - self.centre).reshape(-1, 3) @ self.rotation).reshape(points.shape)

    def world(self, points):
        return points @ self.rotation.T + self.centre

    def bounds(self):
        half = np.array([self.support(axis)[n] - self.centre[n] for n, axis in enumerate(np.eye(3))])
        return self.centre - half, self.centre + half

    def support(self, direction):
        return self.world(self.local_support(direction @ self.rotation))

    def contains(self, low, high):
        """Whether all of each closed cube lies in the open interior."""
        if not self.solid:
            return np.zeros(len(low), bool)
        return self.local_inside(self.local(corners_of(low, high))).all(axis=1)

    def meets_and_contains(self, low, high):
        """Whether the solid meets each closed cube, and whether all of the cube lies in its open interior.

        The distance of the cube's centre from the boundary says it for all but those between the spheres in and about
        the cube: it meets what comes into the inner one, and nothing that stays out of the outer one.
        """
        distance = self.signed_distance((low + high) / 2)
        inner, outer = (high - low).min(axis=-1) / 2 - SLACK, np.linalg.norm(high - low, axis=-1) / 2 + SLACK
        meets, contains = distance < inner, distance < -outer
        near = np.flatnonzero((inner <= distance) & (distance <= outer))
        meets[near] = self.meets(low[near], high[near])
        near = np.flatnonzero((-outer <= distance) & (distance <= -inner))
        contains[near] = self.contains(low[near], high[near])
        return meets, contains

    def boundary_meets(self, low, high):
        """Whether each closed cube meets the boundary, exactly as given (no slack, no epsilon)."""
        meets, contains = self.meets_and_contains(low, high)
        return meets & ~contains

    def signed_distance(self, points):
        """Distance to the boundary, negative inside."""
        local = self.local(points)
        outside = np.linalg.norm(local - self.nearest(local), axis=-1)
        if not self.solid:
            return outside
        inside = self.local_inside(local)
        result = outside
        result[inside] = -self.depth(local[inside])
        return result

    def boundary_distance(self, low, high):
        """Exact distance from each closed cube to the boundary."""
        result = np.zeros(len(low))
        buried = self.contains(low, high)
        if buried.any():  # depth is concave in a convex body, so a corner has the least
            local = self.local(corners_of(low[buried], high[buried]))
            result[buried] = self.depth(local.reshape(-1, 3)).reshape(-1, 8).min(axis=1)
        outside = np.flatnonzero(~buried)
        outside = outside[~self.meets(low[outside], high[outside])]
        result[outside] = self.outer_distance(low[outside], high[outside])
        return result

    def edges_with_a_nearest_point(self, corners, gap):
        """Edges that come nearer to the solid between their ends: the number of the cube, the start, the step to the end.

        gap: from the nearest point of the solid to each corner. Along an edge the distance to a convex solid is convex,
        so its least value lies between the ends exactly if it falls at the start and rises at the end.
        """
        step = corners[:, LAST] - corners[:, FIRST]
        falls, rises = (gap[:, FIRST] * step).sum(-1) < 0, (gap[:, LAST] * step).sum(-1) > 0
        box, edge = np.nonzero(falls & rises)
        return box, corners[box, FIRST[edge]], step[box, edge]

    def least_distance_along(self, start, step):
        """Least distance from each segment to the solid: all segments are halved at once, by the sign of the slope."""
        first, last = np.zeros((len(start), 1)), np.ones((len(start), 1))
        for _ in range(40):
            middle = (first + last) / 2
            point = start + middle * step
            rising = ((point - self.nearest(point)) * step).sum(-1, keepdims=True) > 0
            first, last = np.where(rising, first, middle), np.where(rising, middle, last)
        point = start + (first + last) / 2 * step
        return np.linalg.norm(point - self.nearest(point), axis=-1)

    def outer_distance(self, low, high):
        """Distance from cubes that do not meet the solid: least over their corners, edges and faces."""
        if len(low) == 0:
            return np.zeros(0)
        corners = self.local(corners_of(low, high))
        gap = corners - self.nearest(corners.reshape(-1, 3)).reshape(corners.shape)
        best = np.linalg.norm(gap, axis=-1).min(axis=1)
        box, start, step = self.edges_with_a_nearest_point(corners, gap)
        if len(box):
            np.minimum.at(best, box, self.least_distance_along(start, step))
        for axis, sign in itertools.product(range(3), (-1, 1)):  # a face: the solid's extreme point opposite to it
            point = self.support(-sign * np.eye(3)[axis])
            distance = point[axis] - high[:, axis] if sign > 0 else low[:, axis] - point[axis]
            others = [n for n in range(3) if n != axis]
            over = ((low[:, others] <= point[others]) & (point[others] <= high[:, others])).all(axis=1)
            best = np.where(over & (distance >= 0), np.minimum(best, distance), best)
        return best
