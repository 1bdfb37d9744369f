# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""The primitives of a recording as convex shapes; see convex.py."""

import itertools

import numpy as np

from convex import CORNERS, FIRST, LAST, Shape, clip_line, corners_of, distance_to_boxes, segment_meets_box


class Box(Shape):
    def nearest(self, local):
        return np.clip(local, -self.size, self.size)

    def local_inside(self, local):
        return (np.abs(local) < self.size).all(axis=-1)

    def depth(self, local):
        return (self.size - np.abs(local)).min(axis=-1)

    def local_support(self, direction):
        return np.where(direction >= 0, self.size, -self.size)

    def meets(self, low, high):
        """Two convex polyhedra meet exactly if an edge of one meets the other."""
        mine = self.world(np.where(CORNERS == 0, -self.size, self.size))[:, None]
        result = segment_meets_box(mine[FIRST], mine[LAST], low, high).any(axis=0)
        rest = np.flatnonzero(~result)
        theirs = self.local(corners_of(low[rest], high[rest]))
        result[rest] = segment_meets_box(theirs[:, FIRST], theirs[:, LAST], -self.size, self.size).any(axis=1)
        return result


class Plane(Box):
    """A rectangle: a box without thickness and without inside."""

    solid = False

    def __init__(self, rotation, centre, size):
        super().__init__(rotation, centre, (size[0], size[1], 0.0))


class Sphere(Shape):
    def nearest(self, local):
        length = np.linalg.norm(local, axis=-1, keepdims=True)
        return local * np.minimum(1, self.size[0] / np.maximum(length, 1e-300))

    def local_inside(self, local):
        return np.linalg.norm(local, axis=-1) < self.size[0]

    def depth(self, local):
        return self.size[0] - np.linalg.norm(local, axis=-1)

    def local_support(self, direction):
        return self.size[0] * direction / np.linalg.norm(direction)

    def meets(self, low, high):
        return distance_to_boxes(self.centre, low, high) <= self.size[0]


class Capsule(Shape):
    def spine(self, local):
        result = np.zeros_like(local)
        result[..., 2] = np.clip(local[..., 2], -self.size[1], self.size[1])
        return result

    def nearest(self, local):
        spine = self.spine(local)
        length = np.linalg.norm(local - spine, axis=-1, keepdims=True)
        return spine + (local - spine) * np.minimum(1, self.size[0] / np.maximum(length, 1e-300))

    def local_inside(self, local):
        return np.linalg.norm(local - self.spine(local), axis=-1) < self.size[0]

    def depth(self, local):
        return self.size[0] - np.linalg.norm(local - self.spine(local), axis=-1)

    def local_support(self, direction):
        return self.size[0] * direction / np.linalg.norm(direction) + [0, 0, np.copysign(self.size[1], direction[2])]

    def meets(self, low, high):
        """The squared distance from the spine to a cube is convex with piecewise linear slope: find its zero."""
        half = self.size[1] * self.rotation[:, 2]
        start, step = self.centre - half, 2 * half
        turns = [np.zeros((len(low), 1)), np.ones((len(low), 1))]
        for axis in range(3):
            if step[axis] != 0:
                turns += [((bound[:, axis] - start[axis]) / step[axis])[:, None] for bound in (low, high)]
        turns = np.sort(np.clip(np.hstack(turns), 0, 1), axis=1)
        points = start + turns[..., None] * step
        slope = ((points - np.clip(points, low[:, None], high[:, None])) * step).sum(-1)
        before = np.clip((slope <= 0).sum(axis=1) - 1, 0, turns.shape[1] - 2)
        rows = np.arange(len(low))
        t0, t1, s0, s1 = turns[rows, before], turns[rows, before + 1], slope[rows, before], slope[rows, before + 1]
        share = np.clip(np.where(s1 > s0, -s0 / np.where(s1 > s0, s1 - s0, 1), 1), 0, 1)
        closest = start + (t0 + share * (t1 - t0))[:, None] * step
        return distance_to_boxes(closest, low, high) <= self.size[0]


class Ellipsoid(Shape):
    def foot(self, local):
        """Nearest boundary point, and the multiplier t: p = (1 + t / a^2) y, from the root of a convex function."""
        sizes = self.size
        points = np.maximum(np.abs(local), 1e-14)
        t = (sizes * points - sizes**2).max(axis=-1)
        for _ in range(300):  # Newton from the left of the root: monotone
            ratio = (sizes * points / (sizes**2 + t[..., None]))**2
            value = ratio.sum(-1) - 1
            step = value / (2 * ratio / (sizes**2 + t[..., None])).sum(-1)
            t = t + np.maximum(step, 0)
            if (step <= 1e-15 * (np.abs(t) + sizes.min()**2)).all():
                break
        return np.copysign(sizes**2 * points / (sizes**2 + t[..., None]), local), t

    def nearest(self, local):
        inside = ((local / self.size)**2).sum(-1) <= 1
        result = local.copy()
        result[~inside] = self.foot(local[~inside])[0]
        return result

    def local_inside(self, local):
        return ((local / self.size)**2).sum(-1) < 1

    def depth(self, local):
        return np.linalg.norm(local - self.foot(local)[0], axis=-1)

    def local_support(self, direction):
        return self.size**2 * direction / np.linalg.norm(self.size * direction)

    def meets(self, low, high):
        """Least value of the ellipsoid's quadratic over the cube: every choice of free coordinates, solved exactly."""
        hessian = self.rotation @ np.diag(self.size**-2.0) @ self.rotation.T
        low, high = low - self.centre, high - self.centre
        best = np.full(len(low), np.inf)
        for state in itertools.product((0, 1, 2), repeat=3):  # at low, at high, free
            free = [n for n in range(3) if state[n] == 2]
            held = [n for n in range(3) if state[n] != 2]
            point = np.where(np.array(state) == 0, low, high)
            if free:
                matrix = -np.linalg.solve(hessian[np.ix_(free, free)], hessian[np.ix_(free, held)])
                point[:, free] = point[:, held] @ matrix.T
            legal = ((low <= point) & (point <= high)).all(axis=1)
            value = ((point @ hessian) * point).sum(axis=1)
            best = np.where(legal, np.minimum(best, value), best)
        return best <= 1


class Cylinder(Shape):
    def nearest(self, local):
        radius, half = self.size[:2]
        length = np.linalg.norm(local[..., :2], axis=-1, keepdims=True)
        flat = local[..., :2] * np.minimum(1, radius / np.maximum(length, 1e-300))
        return np.concatenate([flat, np.clip(local[..., 2:], -half, half)], axis=-1)

    def local_inside(self, local):
        return (np.linalg.norm(local[..., :2], axis=-1) < self.size[0]) & (np.abs(local[..., 2]) < self.size[1])

    def depth(self, local):
        return np.minimum(self.size[0] - np.linalg.norm(local[..., :2], axis=-1), self.size[1] - np.abs(local[..., 2]))

    def local_support(self, direction):
        flat = np.linalg.norm(direction[:2])
        rim = direction[:2] * (self.size[0] / flat) if flat > 0 else np.zeros(2)
        return np.array([*rim, np.copysign(self.size[1], direction[2])])

    def meets(self, low, high):
        """Least distance to the axis over the part of the cube between the caps: on the axis, on an edge of the
        cube, or on a line where a face of the cube is cut by a cap's plane."""
        radius, half = self.size[:2]
        normal = self.rotation[:, 2]
        result = segment_meets_box(self.centre - half * normal, self.centre + half * normal, low, high)
        corners = self.local(corners_of(low, high))
        start, step = corners[:, FIRST], corners[:, LAST] - corners[:, FIRST]
        first, last = clip_line(0.0, 1.0, start[..., 2], step[..., 2], -half, half)
        length = (step[..., :2]**2).sum(-1)
        t = -(start[..., :2] * step[..., :2]).sum(-1) / np.where(length > 0, length, 1)
        with np.errstate(invalid="ignore"):
            point = start + np.clip(t, first, np.maximum(first, last))[..., None] * step
            result |= ((first <= last) & (np.linalg.norm(point[..., :2], axis=-1) <= radius)).any(axis=1)
        for axis, cap, bound in itertools.product(range(3), (-half, half), (low, high)):
            lean = 1 - normal[axis]**2
            if lean < 1e-14:
                continue  # parallel to the caps: its edges were tried above
            unit = np.eye(3)[axis]
            middle = self.centre + cap * normal
            offset = bound[:, axis] - middle[axis]
            start = middle + (offset / lean)[:, None] * (unit - normal[axis] * normal)
            step = np.cross(unit, normal) / np.sqrt(lean)
            first, last = np.full(len(low), -np.inf), np.full(len(low), np.inf)
            for other in range(3):
                if other != axis:
                    first, last = clip_line(first, last, start[:, other], step[other], low[:, other], high[:, other])
            along = np.clip(0.0, first, np.maximum(first, last))
            with np.errstate(invalid="ignore"):
                result |= (first <= last) & (offset**2 / lean + along**2 <= radius**2)
        return result


KINDS = {"plane": Plane, "sphere": Sphere, "capsule": Capsule, "ellipsoid": Ellipsoid, "cylinder": Cylinder, "box": Box}
