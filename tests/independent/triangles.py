# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Triangles of meshes and height fields, and the file truth/triangles.ply that holds them."""

import struct

import numpy as np

from convex import Shape, distance_to_boxes, segment_meets_box


class Triangle(Shape):
    """A closed triangle: a convex set without inside. corners: (3, 3) in frame map."""

    solid = False

    def __init__(self, corners):
        super().__init__(np.eye(3), np.zeros(3), np.zeros(3))
        self.corners = corners
        a, b, c = corners
        self.basis = np.stack([b - a, c - a], axis=-1)
        self.inverse = np.linalg.pinv(self.basis)

    def bounds(self):
        return self.corners.min(axis=0), self.corners.max(axis=0)

    def support(self, direction):
        return self.corners[(self.corners @ direction).argmax()]

    def nearest(self, points):
        """On the face where the foot of the perpendicular lies in it, else on the nearest side."""
        a, b, c = self.corners
        share = (points - a) @ self.inverse.T
        inside = (share >= 0).all(axis=-1) & (share.sum(axis=-1) <= 1)
        best = a + share @ self.basis.T
        least = np.where(inside, np.linalg.norm(points - best, axis=-1), np.inf)
        for start, end in ((a, b), (b, c), (c, a)):
            step = end - start
            t = np.clip((points - start) @ step / max(step @ step, 1e-300), 0, 1)
            foot = start + t[..., None] * step
            distance = np.linalg.norm(points - foot, axis=-1)
            best = np.where((distance < least)[..., None], foot, best)
            least = np.minimum(least, distance)
        return best

    def meets(self, low, high):
        """A side of the triangle meets the cube, or an edge of the cube the triangle."""
        start, end = self.corners[:, None], np.roll(self.corners, -1, axis=0)[:, None]
        result = segment_meets_box(start, end, low, high).any(axis=0)
        for axis in range(3):
            others = [n for n in range(3) if n != axis]
            a, b, c = self.corners[:, others]
            basis = np.stack([b - a, c - a], axis=-1)
            if abs(np.linalg.det(basis)) < 1e-14:
                continue  # parallel to these edges: where they meet, a side meets the cube too
            at = np.concatenate([np.stack([first[:, others[0]], second[:, others[1]]], axis=-1)
                                 for first in (low, high) for second in (low, high)])  # of the four edges
            share = np.linalg.solve(basis, (at - a).T).T
            height = self.corners[0, axis] + share @ (self.corners[1:, axis] - self.corners[0, axis])
            inside = (share >= -1e-12).all(axis=-1) & (share.sum(axis=-1) <= 1 + 1e-12)
            height, inside = height.reshape(4, -1), inside.reshape(4, -1)
            result |= (inside & (low[:, axis] <= height) & (height <= high[:, axis])).any(axis=0)
        return result

    def outer_distance(self, low, high):
        """Any corner may be the nearest to a face that the triangle is parallel to."""
        best = super().outer_distance(low, high)
        for corner in self.corners:
            best = np.minimum(best, distance_to_boxes(corner, low, high))
        return best


def read_triangles(path, T_map_world):
    """[(instance, Triangle)] of a recording's triangles.ply."""
    with open(path, "rb") as file:
        head, _, body = file.read().partition(b"end_header\n")
    lines = [line.split() for line in head.decode().splitlines()]
    counts = {line[1]: int(line[2]) for line in lines if line[0] == "element"}
    if [line[1:] for line in lines if line[0] == "property"] != [
            ["double", "x"], ["double", "y"], ["double", "z"], ["list", "uchar", "int", "vertex_indices"],
            ["ushort", "instance"], ["int", "geom"]]:
        raise ValueError(f"{path}: other properties than docs/formats.md lists")
    vertices = np.frombuffer(body, "<f8", 3 * counts["vertex"]).reshape(-1, 3)
    faces = struct.iter_unpack("<BiiiHi", body[vertices.nbytes:])
    points = vertices @ T_map_world[:3, :3].T + T_map_world[:3, 3]
    return [(instance, Triangle(points[[a, b, c]])) for _, a, b, c, instance, _ in faces]
