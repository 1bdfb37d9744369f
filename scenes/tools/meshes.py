#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes the curved things of the homes into scenes/meshes: closed, metres, as few facets as look right."""

import math
import pathlib
import sys

import numpy as np

from solid import Solid, lathe, loft, ring, sheet, tube, turned


def arc(centre, radius, start_deg, end_deg, count):
    """Points (r, z) of a profile on an arc."""
    angles = np.linspace(math.radians(start_deg), math.radians(end_deg), count)
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def mug(radius, height, wall=0.0035):
    """A cup 3.5 mm thick, with a handle towards +x."""
    body = lathe([(0, 0), (radius - 0.004, 0), (radius, 0.004), (radius, height), (radius - wall, height),
                  (radius - wall, 0.008), (0, 0.008)], 24)
    bow = [(radius - 0.002 + 0.029 * math.sin(a), 0, height * 0.52 - 0.031 * math.cos(a))
           for a in np.linspace(0.12, math.pi - 0.12, 9)]
    return body.merge(tube(bow, 0.0048, 8))


def bowl(radius, height, wall=0.005):
    outside = [(0.45 * radius, 0)] + [(radius * (0.45 + 0.55 * math.sin(t)), height * (1 - math.cos(t)))
                                      for t in np.linspace(0.15, math.pi / 2, 6)]
    inside = [(max(0.0, r - wall), max(z, wall)) for r, z in reversed(outside)]
    return lathe([(0, 0)] + outside + inside + [(0, wall)], 28)


def plate():
    return lathe([(0, 0), (0.07, 0), (0.122, 0.013), (0.123, 0.017), (0.118, 0.017), (0.075, 0.006), (0, 0.006)], 28)


def wine_bottle():
    return lathe([(0, 0), (0.034, 0), (0.0375, 0.004), (0.0375, 0.19), (0.035, 0.205), (0.026, 0.222), (0.0165, 0.236),
                  (0.0145, 0.25), (0.0145, 0.292), (0.0165, 0.292), (0.0165, 0.303), (0, 0.303)], 20)


def water_bottle():
    return lathe([(0, 0), (0.037, 0), (0.041, 0.006), (0.041, 0.07), (0.038, 0.085), (0.038, 0.1), (0.041, 0.115), (0.041, 0.185),
                  (0.036, 0.21), (0.022, 0.235), (0.014, 0.245), (0.014, 0.255), (0.0175, 0.255), (0.0175, 0.274), (0, 0.274)], 20)


def soap_bottle():
    body = lathe([(0, 0), (0.031, 0), (0.034, 0.004), (0.034, 0.12), (0.028, 0.137), (0.011, 0.145), (0.011, 0.165), (0.004, 0.165),
                  (0.004, 0.19), (0, 0.19)], 18)
    return body.merge(tube([(-0.012, 0, 0.19), (0.02, 0, 0.19), (0.04, 0, 0.182)], 0.006, 8))


def vase():
    outside = [(0.045, 0), (0.062, 0.03), (0.078, 0.08), (0.08, 0.12), (0.066, 0.17), (0.042, 0.21), (0.034, 0.235), (0.043, 0.262)]
    inside = [(0.037, 0.262), (0.028, 0.235), (0.036, 0.21), (0.058, 0.17), (0.07, 0.1), (0.05, 0.02)]
    return lathe([(0, 0)] + outside + inside + [(0, 0.02)], 24)


def flower_pot(radius, height):
    rim = 0.012
    return lathe([(0, 0), (0.72 * radius, 0), (0.95 * radius, height - 0.05), (radius, height - 0.05), (radius, height),
                  (radius - rim, height), (radius - rim, height - 0.03), (0, height - 0.03)], 26)


def lamp_shade(bottom, top, height):
    """Open at both ends, 3 mm of cloth."""
    t = 0.003
    return lathe([(bottom, 0), (top, height), (top - t, height), (bottom - t, 0), (bottom, 0)], 28)


def lamp_foot():
    return lathe([(0, 0), (0.065, 0), (0.07, 0.008), (0.06, 0.02), (0.062, 0.05), (0.075, 0.09), (0.07, 0.13), (0.04, 0.17), (0.016, 0.19),
                  (0.012, 0.26), (0, 0.26)], 20)


def kettle():
    body = lathe([(0, 0), (0.082, 0), (0.088, 0.008), (0.086, 0.06), (0.072, 0.13), (0.055, 0.165), (0.05, 0.172), (0.025, 0.183),
                  (0.012, 0.186), (0.014, 0.2), (0.008, 0.207), (0, 0.207)], 24)
    body.merge(tube([(-0.05, 0, 0.165), (-0.09, 0, 0.185), (-0.125, 0, 0.16), (-0.13, 0, 0.1), (-0.11, 0, 0.045), (-0.08, 0, 0.035)],
                    0.011, 8))
    return body.merge(tube([(0.07, 0, 0.09), (0.1, 0, 0.115), (0.125, 0, 0.155)], [0.022, 0.016, 0.012], 8))


def pot():
    body = lathe([(0, 0), (0.1, 0), (0.107, 0.008), (0.107, 0.12), (0.111, 0.122), (0.108, 0.128), (0.06, 0.142), (0.012, 0.146), (0.01, 0.16),
                  (0.02, 0.168), (0.018, 0.176), (0, 0.178)], 26)
    for side in (1, -1):
        ear = [(0.1, side * -0.035, 0.095), (0.137, side * -0.03, 0.097), (0.142, 0, 0.098), (0.137, side * 0.03, 0.097), (0.1, side * 0.035, 0.095)]
        body.merge(tube([(side * x, y, z) for x, y, z in ear], 0.006, 6))
    return body


def pan():
    body = lathe([(0, 0), (0.105, 0), (0.128, 0.042), (0.131, 0.045), (0.126, 0.045), (0.103, 0.006), (0, 0.006)], 26)
    return body.merge(tube([(0.12, 0, 0.034), (0.2, 0, 0.052), (0.31, 0, 0.062)], [0.008, 0.011, 0.012], 8))


def basket():
    outside = [(0.15, 0), (0.17, 0.15), (0.187, 0.3), (0.197, 0.43), (0.206, 0.434), (0.206, 0.46)]
    inside = [(0.19, 0.46), (0.175, 0.3), (0.14, 0.015)]
    return lathe([(0, 0)] + outside + inside + [(0, 0.015)], 26)


def tap(reach, height):
    """A bent pipe towards +x, with a lever."""
    path = [(0, 0, 0), (0, 0, height - 0.05)]
    path += [(reach / 2 - reach / 2 * math.cos(a), 0, height - 0.05 + 0.05 * math.sin(a)) for a in np.linspace(0.3, math.pi, 8)]
    path += [(reach, 0, height - 0.085)]
    body = tube(path, 0.0115, 10)
    body.merge(lathe([(0, 0), (0.024, 0), (0.024, 0.045), (0, 0.045)], 14))
    return body.merge(tube([(0, 0.02, 0.03), (0, 0.055, 0.045), (0.01, 0.09, 0.075)], 0.007, 8))


def basin(half_x, half_y, depth, rim, power=4.0, count=28, foot=0.55):
    """A bowl with a rim: half extents at the top, wall `rim`; origin in the middle of the rim's upper face."""
    outside = [ring(half_x * s, half_y * s, z, count, power) for s, z in
               ((foot, -depth - 0.015), (0.8, -0.6 * depth), (0.97, -0.3 * depth), (1.0, -0.02), (1.0, 0.0))]
    x, y = half_x - rim, half_y - rim
    inside = [ring(x * s, y * s, z, count, power) for s, z in
              ((1.0, 0.0), (0.97, -0.25 * depth), (0.88, -0.7 * depth), (0.7, -0.93 * depth), (0.05, -depth))]
    solid = loft(outside, capped=False)
    solid.merge(loft([outside[-1], inside[0]], capped=False))
    solid.merge(loft(inside, capped=False))
    for section, flip in ((outside[0], True), (inside[-1], False)):
        fan = [(0, 1 + j, 1 + (j + 1) % count) for j in range(count)]
        middle = np.mean(np.array(section), axis=0)
        solid.add([middle] + section, [(0.5, 0.5)] * (count + 1), [f[::-1] for f in fan] if flip else fan)
    return solid


def toilet():
    """Bowl with seat; the wall is at x = 0, the front at x = 0.66; the cistern is a box beside it."""
    count = 26
    outside = [ring(a, b, z, count, 2.4, x) for a, b, z, x in
               ((0.21, 0.11, 0, 0.37), (0.19, 0.1, 0.1, 0.37), (0.2, 0.12, 0.2, 0.38), (0.235, 0.16, 0.3, 0.405), (0.25, 0.178, 0.365, 0.41),
                (0.25, 0.178, 0.385, 0.41))]
    seat = [ring(a, b, z, count, 2.2, x) for a, b, z, x in
            ((0.255, 0.185, 0.387, 0.41), (0.26, 0.19, 0.4, 0.41), (0.255, 0.185, 0.41, 0.41), (0.165, 0.105, 0.41, 0.425),
             (0.15, 0.095, 0.36, 0.425), (0.1, 0.06, 0.23, 0.41), (0.01, 0.01, 0.21, 0.4))]
    return loft(outside).merge(loft(seat))


def pillow(half_x, half_y, half_z, cells=10):
    """Puffed in the middle, thin at the seam, lying."""
    def face(side):
        points, uvs = [], []
        for v in np.linspace(-1, 1, cells + 1):
            for u in np.linspace(-1, 1, cells + 1):
                bulge = ((1 - u ** 4) * (1 - v ** 4)) ** 0.6
                pinch = 1 - 0.07 * (1 - abs(u)) * abs(v) ** 3 - 0.07 * (1 - abs(v)) * abs(u) ** 3
                points.append((half_x * u * pinch, half_y * v * pinch, side * half_z * (0.06 + 0.94 * bulge)))
                uvs.append((0.5 + 0.5 * u, 0.5 + 0.5 * v))
        return points, uvs
    from solid import grid_faces
    solid = Solid()
    faces = grid_faces(cells + 1, cells + 1)
    solid.add(*face(1), faces)
    solid.add(*face(-1), [f[::-1] for f in faces])
    edge = [(u, -1) for u in np.linspace(-1, 1, cells + 1)] + [(1, v) for v in np.linspace(-1, 1, cells + 1)[1:]]
    edge += [(u, 1) for u in np.linspace(1, -1, cells + 1)[1:]] + [(-1, v) for v in np.linspace(1, -1, cells + 1)[1:]]
    rows = [(half_x * u, half_y * v, side * half_z * 0.06) for side in (-1, 1) for u, v in edge]
    return solid.add(rows, [(0.5 + 0.5 * u, 0.5 + 0.5 * v) for u, v in edge] * 2, grid_faces(2, len(edge)))


def soft_block(edge=0.16):
    """A cube of edge 1 with round edges, to be scaled into cushions and mattresses."""
    sections = []
    for z, inset in ((-0.5, edge), (-0.5 + 0.3 * edge, 0.3 * edge), (-0.5 + edge, 0), (0.5 - edge, 0), (0.5 - 0.3 * edge, 0.3 * edge),
                     (0.5, edge)):
        sections.append(ring(0.5 - inset, 0.5 - inset, z, 32, 9.0))
    return loft(sections)


def curtain(width, height, folds):
    """Hangs from z = 0 down, along y, folded towards x."""
    def point(u, v):
        depth = 0.028 * (0.75 + 0.5 * v) * math.sin(2 * math.pi * folds * u) + 0.008 * math.sin(5 * math.pi * u + 1)
        return depth, width * (u - 0.5) * (1 - 0.06 * math.sin(math.pi * v)), -height * v
    return sheet(6, 8 * folds + 1, point, 0.004)


def duvet(half_x, half_y, drop):
    """Covers a mattress: top at z = 0 with soft waves, sides hanging down; +x is the foot."""
    def point(u, v):
        x, y = half_x * (2 * u - 1), half_y * 1.32 * (2 * v - 1)
        wave = 0.012 * math.sin(7 * x + 2 * y) * math.cos(5 * y - 1.3 * x) + 0.008 * math.sin(13 * y + x)
        over = max(0.0, abs(y) - half_y)
        bend = min(1.0, over / (0.32 * half_y))
        return x, math.copysign(min(abs(y), half_y + 0.022 * bend), y), 0.03 + wave * (1 - bend) - drop * bend - 0.03 * (abs(y) / (1.32 * half_y)) ** 4
    return sheet(17, 13, point, 0.02)


def leaf(length, width, droop, fold=0.25):
    """A blade from the origin along +x."""
    def point(u, v):
        half = width / 2 * (math.sin(math.pi * min(1.0, 0.06 + 0.94 * u)) ** 0.7 if u < 1 else 0.0)
        side = 2 * v - 1
        return length * u * math.cos(droop * u), -half * side, length * u * math.sin(0.6 - droop * u * 1.5) + fold * half * abs(side)
    return sheet(3, 7, lambda u, v: point(0.02 + 0.96 * u, 1 - v), 0.003)


def ficus(seed=3, leaves=22, height=0.95):
    """Stems and leaves, from the soil at z = 0."""
    random = Weyl(seed)
    plant = tube([(0, 0, -0.03), (0.015, 0.01, height * 0.4), (-0.01, 0.02, height * 0.8)], [0.013, 0.01, 0.006], 7)
    plant.merge(tube([(0.02, -0.02, -0.03), (0.05, -0.05, height * 0.3), (0.07, -0.03, height * 0.62)], [0.01, 0.008, 0.005], 7))
    for i in range(leaves):
        z = height * (0.22 + 0.66 * i / leaves)
        blade = leaf(0.2 + 0.13 * random(), 0.1 + 0.05 * random(), 0.5 + 0.5 * random())
        plant.merge(blade, (0.02 * random(), 0.02 * random(), z), turned(137.5 * i, -18 + 30 * random() - 28 * i / leaves))
    return plant


def sword_plant(seed=5, leaves=11):
    random = Weyl(seed)
    plant = Solid()
    for i in range(leaves):
        length, width, lean = 0.36 + 0.3 * random(), 0.05 + 0.02 * random(), 0.1 + 0.22 * random()
        def point(u, v, length=length, width=width, lean=lean):
            half = width / 2 * (1 - u ** 3) * (0.7 + 0.6 * u)
            return length * lean * u * u + 0.02, half * (2 * v - 1), length * u - 0.02
        plant.merge(sheet(3, 6, lambda u, v: point(0.98 * u, v), 0.004), (0.02 * random(), 0.02 * random(), 0), turned(137.5 * i))
    return plant


def tulips(seed=7, flowers=7):
    """Stems and leaves, and heads apart: two files, two colours."""
    random, stems, heads = Weyl(seed), Solid(), Solid()
    for i in range(flowers):
        phi, lean, height = math.radians(137.5 * i), 0.03 + 0.09 * i / flowers, 0.36 + 0.08 * random()
        top = np.array((lean * math.cos(phi), lean * math.sin(phi), height))
        stems.merge(tube([(0, 0, 0.08), 0.35 * top + (0, 0, 0.05), top], 0.003, 5))
        bud = lathe([(0, -0.004), (0.014, 0.004), (0.019, 0.02), (0.016, 0.04), (0.009, 0.052), (0, 0.044)], 10)
        heads.merge(bud, top)
        if i % 2:
            stems.merge(leaf(0.2, 0.03, 0.6), (0, 0, 0.2), turned(137.5 * i + 60, -35))
    return stems, heads


def chair_seat(half_x, half_y, thick):
    return loft([ring(half_x * s, half_y * s, z, 28, 4.5) for s, z in
                 ((0.9, 0), (0.98, 0.25 * thick), (1.0, 0.55 * thick), (0.97, 0.85 * thick), (0.86, thick))])


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
            x, z, width = -0.165 - 0.1 * math.sin(a * 1.3), 0.42 * a ** 1.25, 0.44 - 0.05 * a
        rise = 0.055 * side ** 4 + 0.02 * side * side
        return x + (rise if t > 0.8 else 0), width / 2 * side, z + (rise if t <= 0.9 else 0.3 * rise)
    return sheet(9, 17, point, 0.012)


class Weyl:
    """Numbers in 0..1 that are the same everywhere."""

    def __init__(self, seed):
        self.state = seed * 0.7548776662466927 % 1

    def __call__(self):
        self.state = (self.state + 0.6180339887498949) % 1
        return self.state * 7.13 % 1


def all_meshes():
    stems, heads = tulips()
    return {
        "mug": mug(0.041, 0.095), "mug_low": mug(0.047, 0.074), "bowl": bowl(0.14, 0.075), "bowl_small": bowl(0.075, 0.055),
        "plate": plate(), "wine_bottle": wine_bottle(), "water_bottle": water_bottle(), "soap_bottle": soap_bottle(),
        "vase": vase(), "tulip_stems": stems, "tulip_heads": heads, "flower_pot": flower_pot(0.17, 0.3), "flower_pot_small": flower_pot(0.075, 0.13),
        "ficus": ficus(), "sword_plant": sword_plant(), "shade_floor": lamp_shade(0.21, 0.15, 0.26), "shade_table": lamp_shade(0.14, 0.08, 0.18),
        "shade_pendant": lamp_shade(0.2, 0.06, 0.18), "lamp_foot": lamp_foot(), "kettle": kettle(), "pot": pot(), "pan": pan(), "basket": basket(),
        "tap": tap(0.15, 0.24), "tap_low": tap(0.12, 0.17), "kitchen_sink": basin(0.2, 0.25, 0.17, 0.012, 7.0, 28, 0.9),
        "wash_basin": basin(0.215, 0.29, 0.13, 0.028, 3.4), "bath": basin(0.36, 0.83, 0.42, 0.05, 5.0, 32, 0.82), "toilet": toilet(),
        "pillow": pillow(0.22, 0.33, 0.075), "cushion": pillow(0.21, 0.21, 0.075), "soft_block": soft_block(),
        "curtain": curtain(0.52, 2.2, 5), "duvet": duvet(0.72, 0.83, 0.24), "duvet_single": duvet(0.7, 0.47, 0.22), "chair_seat": chair_seat(0.235, 0.235, 0.075),
        "chair_back": chair_back(0.43, 0.52, 0.07, 0.035), "chair_rail": chair_back(0.37, 0.1, 0.035, 0.018), "shell_chair": shell_chair(),
    }


def write_all(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, solid in all_meshes().items():
        solid.write(folder / f"{name}.obj")


if __name__ == "__main__":
    write_all(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "meshes")
