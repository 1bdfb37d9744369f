# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Meshes of porcelain, cushions, cloth and seats."""

import math

import numpy as np

from solid import Solid, grid_faces, loft, ring, sheet


def basin(half_x, half_y, depth, rim, power=4.0, count=28, foot=0.55):
    """A bowl with a rim: half extents at the top, wall `rim`.

    Origin in the middle of the rim's upper face.
    """
    outside = [
        ring(half_x * s, half_y * s, z, count, power)
        for s, z in (
            (foot, -depth - 0.015),
            (0.8, -0.6 * depth),
            (0.97, -0.3 * depth),
            (1.0, -0.02),
            (1.0, 0.0),
        )
    ]
    x, y = half_x - rim, half_y - rim
    inside = [
        ring(x * s, y * s, z, count, power)
        for s, z in (
            (1.0, 0.0),
            (0.97, -0.25 * depth),
            (0.88, -0.7 * depth),
            (0.7, -0.93 * depth),
            (0.05, -depth),
        )
    ]
    solid = loft(outside, capped=False)
    solid.merge(loft([outside[-1], inside[0]], capped=False))
    solid.merge(loft(inside, capped=False))
    for section, flip in ((outside[0], True), (inside[-1], False)):
        fan = [(0, 1 + j, 1 + (j + 1) % count) for j in range(count)]
        middle = np.mean(np.array(section), axis=0)
        solid.add(
            [middle] + section, [(0.5, 0.5)] * (count + 1), [f[::-1] for f in fan] if flip else fan
        )
    return solid


def toilet():
    """Bowl with seat.

    The wall is at x = 0, the front at x = 0.66; the cistern is a box beside it.
    """
    count = 26
    outside = [
        ring(a, b, z, count, 2.4, x)
        for a, b, z, x in (
            (0.21, 0.11, 0, 0.37),
            (0.19, 0.1, 0.1, 0.37),
            (0.2, 0.12, 0.2, 0.38),
            (0.235, 0.16, 0.3, 0.405),
            (0.25, 0.178, 0.365, 0.41),
            (0.25, 0.178, 0.385, 0.41),
        )
    ]
    seat = [
        ring(a, b, z, count, 2.2, x)
        for a, b, z, x in (
            (0.255, 0.185, 0.387, 0.41),
            (0.26, 0.19, 0.4, 0.41),
            (0.255, 0.185, 0.41, 0.41),
            (0.165, 0.105, 0.41, 0.425),
            (0.15, 0.095, 0.36, 0.425),
            (0.1, 0.06, 0.23, 0.41),
            (0.01, 0.01, 0.21, 0.4),
        )
    ]
    return loft(outside).merge(loft(seat))


def pillow(half_x, half_y, half_z, cells=10):
    """Puffed in the middle, thin at the seam, lying."""

    def face(side):
        points, uvs = [], []
        for v in np.linspace(-1, 1, cells + 1):
            for u in np.linspace(-1, 1, cells + 1):
                bulge = ((1 - u**4) * (1 - v**4)) ** 0.6
                pinch = 1 - 0.07 * (1 - abs(u)) * abs(v) ** 3 - 0.07 * (1 - abs(v)) * abs(u) ** 3
                points.append(
                    (half_x * u * pinch, half_y * v * pinch, side * half_z * (0.06 + 0.94 * bulge))
                )
                uvs.append((0.5 + 0.5 * u, 0.5 + 0.5 * v))
        return points, uvs

    solid = Solid()
    faces = grid_faces(cells + 1, cells + 1)
    solid.add(*face(1), faces)
    solid.add(*face(-1), [f[::-1] for f in faces])
    edge = [(u, -1) for u in np.linspace(-1, 1, cells + 1)] + [
        (1, v) for v in np.linspace(-1, 1, cells + 1)[1:]
    ]
    edge += [(u, 1) for u in np.linspace(1, -1, cells + 1)[1:]] + [
        (-1, v) for v in np.linspace(1, -1, cells + 1)[1:]
    ]
    rows = [(half_x * u, half_y * v, side * half_z * 0.06) for side in (-1, 1) for u, v in edge]
    return solid.add(
        rows, [(0.5 + 0.5 * u, 0.5 + 0.5 * v) for u, v in edge] * 2, grid_faces(2, len(edge))
    )


def soft_block(edge=0.16):
    """A cube of edge 1 with round edges, to be scaled into cushions and mattresses."""
    sections = []
    for z, inset in (
        (-0.5, edge),
        (-0.5 + 0.3 * edge, 0.3 * edge),
        (-0.5 + edge, 0),
        (0.5 - edge, 0),
        (0.5 - 0.3 * edge, 0.3 * edge),
        (0.5, edge),
    ):
        sections.append(ring(0.5 - inset, 0.5 - inset, z, 32, 9.0))
    return loft(sections)


def curtain(width, height, folds):
    """Hangs from z = 0 down, along y, folded towards x."""

    def point(u, v):
        depth = 0.028 * (0.75 + 0.5 * v) * math.sin(2 * math.pi * folds * u) + 0.008 * math.sin(
            5 * math.pi * u + 1
        )
        return depth, width * (u - 0.5) * (1 - 0.06 * math.sin(math.pi * v)), -height * v

    return sheet(6, 8 * folds + 1, point, 0.004)


def duvet(half_x, half_y, drop):
    """Covers a mattress: top at z = 0 with soft waves, sides hanging down; +x is the foot."""

    def point(u, v):
        x, y = half_x * (2 * u - 1), half_y * 1.32 * (2 * v - 1)
        wave = 0.012 * math.sin(7 * x + 2 * y) * math.cos(5 * y - 1.3 * x) + 0.008 * math.sin(
            13 * y + x
        )
        over = max(0.0, abs(y) - half_y)
        bend = min(1.0, over / (0.32 * half_y))
        return (
            x,
            math.copysign(min(abs(y), half_y + 0.022 * bend), y),
            0.03 + wave * (1 - bend) - drop * bend - 0.03 * (abs(y) / (1.32 * half_y)) ** 4,
        )

    return sheet(17, 13, point, 0.02)


def chair_seat(half_x, half_y, thick):
    return loft(
        [
            ring(half_x * s, half_y * s, z, 28, 4.5)
            for s, z in (
                (0.9, 0),
                (0.98, 0.25 * thick),
                (1.0, 0.55 * thick),
                (0.97, 0.85 * thick),
                (0.86, thick),
            )
        ]
    )


def chair_back(width, height, hollow, thick):
    """A shell bent about z, its middle at x = 0, z = 0 .. height; the sitter is at +x."""

    def point(u, v):
        side = 2 * u - 1
        narrow = 1 - 0.1 * abs(2 * v - 1) ** 3
        return hollow * side * side - 0.1 * height * v * v, -width / 2 * side * narrow, height * v

    return sheet(7, 9, point, thick)


def shell_chair():
    """Seat and back of one bent piece, front towards +x, seat at z = 0."""

    def point(u, v):
        side = 2 * v - 1
        t = u * 1.35
        if t < 0.7:
            x, z, width = 0.22 - 0.55 * t, 0.012 * math.cos(4 * t), 0.44
        else:
            a = (t - 0.7) / 0.65
            x, z, width = -0.165 - 0.1 * math.sin(a * 1.3), 0.42 * a**1.25, 0.44 - 0.05 * a
        rise = 0.055 * side**4 + 0.02 * side * side
        return (
            x + (rise if t > 0.8 else 0),
            width / 2 * side,
            z + (rise if t <= 0.9 else 0.3 * rise),
        )

    return sheet(9, 17, point, 0.012)
