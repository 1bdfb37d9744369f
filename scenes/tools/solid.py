# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Triangle meshes of turned, swept and padded things, and their OBJ files.

Metres, z up, faces wind outwards.
"""

import math

import numpy as np

CREASE = math.cos(
    math.radians(38)
)  # sharper turns of a profile get vertices, and normals, of their own


class Solid:
    """Vertices, texture coordinates (one each) and triangles."""

    def __init__(self):
        self.vertices, self.uvs, self.faces = [], [], []

    def add(self, points, uvs, faces):
        first = len(self.vertices)
        self.vertices += [tuple(p) for p in points]
        self.uvs += [tuple(uv) for uv in uvs]
        self.faces += [tuple(first + i for i in face) for face in faces]
        return self

    def merge(self, other, offset=(0, 0, 0), turn=None):
        points = np.array(other.vertices, float)
        if turn is not None:
            points = points @ np.asarray(turn, float).T
        return self.add(points + np.asarray(offset, float), other.uvs, other.faces)

    def write(self, path):
        lines = ["# mapscore scenes/tools/meshes.py, MIT"]
        lines += ["v " + " ".join(decimal(c) for c in p) for p in self.vertices]
        lines += ["vt " + " ".join(decimal(c, 3) for c in uv) for uv in self.uvs]
        lines += [
            "f " + " ".join(f"{i + 1}/{i + 1}" for i in face)
            for face in self.faces
            if len(set(face)) == 3
        ]
        path.write_text("\n".join(lines) + "\n")


def decimal(value, digits=4):
    """Rounded off the ties, so that the last bit of a sine changes no byte."""
    value = round(float(value) + 1.3e-8, digits) + 0.0
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def grid_faces(rows, columns):
    """Two triangles a cell.

    Rows run along the first axis, the normal is column direction x row direction.
    """
    faces = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b, c, d = (
                i * columns + j,
                i * columns + j + 1,
                (i + 1) * columns + j + 1,
                (i + 1) * columns + j,
            )
            faces += [(a, b, c), (a, c, d)]
    return faces


def smooth_runs(profile):
    """Cuts a profile at its creases."""
    runs, run = [], [profile[0]]
    for i in range(1, len(profile)):
        run.append(profile[i])
        if i + 1 < len(profile):
            a = np.subtract(profile[i], profile[i - 1])
            b = np.subtract(profile[i + 1], profile[i])
            if a @ b < CREASE * np.linalg.norm(a) * np.linalg.norm(b):
                runs.append(run)
                run = [profile[i]]
    return runs + [run]


def lathe(profile, sides, squash=lambda phi: 1.0):
    """Turns (radius, z) about z; upwards outside, downwards inside.

    squash(phi) makes the round oval.
    """
    solid = Solid()
    for run in smooth_runs(profile):
        points, uvs = [], []
        for k, (radius, z) in enumerate(run):
            for j in range(sides + 1):
                phi = 2 * math.pi * (j % sides) / sides
                r = radius * squash(phi)
                points.append((r * math.cos(phi), r * math.sin(phi), z))
                uvs.append((j / sides, k / (len(run) - 1)))
        solid.add(points, uvs, grid_faces(len(run), sides + 1))
    return weld_poles(solid)


def weld_poles(solid):
    """Drops the triangles that have no area."""
    keep = []
    for face in solid.faces:
        a, b, c = (np.array(solid.vertices[i]) for i in face)
        if np.linalg.norm(np.cross(b - a, c - a)) > 1e-9:
            keep.append(face)
    solid.faces = keep
    return solid


def loft(sections, capped=True):
    """Skin over rings of points (all of one length, seen from above anticlockwise, from bottom to
    top)."""
    solid = Solid()
    count = len(sections[0])
    points = [p for ring in sections for p in list(ring) + [ring[0]]]
    uvs = [
        (j / count, i / max(1, len(sections) - 1))
        for i in range(len(sections))
        for j in range(count + 1)
    ]
    solid.add(points, uvs, grid_faces(len(sections), count + 1))
    if capped:
        for ring, flip in ((sections[0], True), (sections[-1], False)):
            middle = np.mean(np.array(ring), axis=0)
            fan = [(0, 1 + j, 1 + (j + 1) % count) for j in range(count)]
            solid.add(
                [middle] + list(ring),
                [(0.5, 0.5)] * (count + 1),
                [f[::-1] for f in fan] if flip else fan,
            )
    return weld_poles(solid)


def ring(half_x, half_y, z, count, power=2.0, x=0.0, y=0.0):
    """A superellipse: power 2 is an ellipse, 5 a rectangle with round corners."""
    points = []
    for j in range(count):
        phi = 2 * math.pi * (j + 0.5) / count
        c, s = math.cos(phi), math.sin(phi)
        points.append(
            (
                x + half_x * math.copysign(abs(c) ** (2 / power), c),
                y + half_y * math.copysign(abs(s) ** (2 / power), s),
                z,
            )
        )
    return points


def tube(path, radius, sides, closed_ends=True):
    """A round bar along points; radius is a number or one a point."""
    path = np.array(path, float)
    radii = np.broadcast_to(np.asarray(radius, float), (len(path),))
    side = None
    sections = []
    for i, p in enumerate(path):
        along = path[min(i + 1, len(path) - 1)] - path[max(i - 1, 0)]
        along /= np.linalg.norm(along)
        if side is None:
            side = np.cross(along, (0, 0, 1) if abs(along[2]) < 0.9 else (0, 1, 0))
        side = side - along * (side @ along)
        side /= np.linalg.norm(side)
        other = np.cross(along, side)
        sections.append(
            [
                p + radii[i] * (math.cos(a) * side + math.sin(a) * other)
                for a in (2 * math.pi * j / sides for j in range(sides))
            ]
        )
    return loft(sections, closed_ends)


def sheet(rows, columns, point, thickness):
    """A closed sheet: point(u, v) in its middle, u along columns, v along rows, both 0..1.

    A face on each side.
    """
    us, vs = np.linspace(0, 1, columns), np.linspace(0, 1, rows)
    middle = np.array([[point(u, v) for u in us] for v in vs], float)
    du, dv = np.gradient(middle, axis=1), np.gradient(middle, axis=0)
    normal = np.cross(du, dv)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    front, back = middle + normal * thickness / 2, middle - normal * thickness / 2
    uvs = [(u, v) for v in vs for u in us]
    solid = Solid()
    solid.add(front.reshape(-1, 3), uvs, grid_faces(rows, columns))
    solid.add(back.reshape(-1, 3), uvs, [f[::-1] for f in grid_faces(rows, columns)])
    rim = [(0, j) for j in range(columns)] + [(i, columns - 1) for i in range(1, rows)]
    rim += [(rows - 1, j) for j in range(columns - 2, -1, -1)] + [
        (i, 0) for i in range(rows - 2, -1, -1)
    ]
    edge = [back[i][j] for i, j in rim] + [front[i][j] for i, j in rim]
    edge_uvs = [(us[j], vs[i]) for i, j in rim] * 2
    return solid.add(edge, edge_uvs, grid_faces(2, len(rim)))


def turned(yaw_deg=0.0, pitch_deg=0.0):
    """Rotation Rz(yaw) Ry(pitch)."""
    a, b = math.radians(yaw_deg), math.radians(pitch_deg)
    z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    y = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    return z @ y
