# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Meshes of plants; leaves are thin closed sheets."""

import math

import numpy as np

from solid import Solid, lathe, sheet, tube, turned


class Weyl:
    """Numbers in 0..1 that are the same everywhere."""

    def __init__(self, seed):
        self.state = seed * 0.7548776662466927 % 1

    def __call__(self):
        self.state = (self.state + 0.6180339887498949) % 1
        return self.state * 7.13 % 1


def leaf(length, width, droop, fold=0.25):
    """A blade from the origin along +x."""

    def point(u, v):
        half = width / 2 * (math.sin(math.pi * min(1.0, 0.06 + 0.94 * u)) ** 0.7 if u < 1 else 0.0)
        side = 2 * v - 1
        return (
            length * u * math.cos(droop * u),
            -half * side,
            length * u * math.sin(0.6 - droop * u * 1.5) + fold * half * abs(side),
        )

    return sheet(3, 7, lambda u, v: point(0.02 + 0.96 * u, 1 - v), 0.003)


def ficus(seed=3, leaves=22, height=0.95):
    """Stems and leaves, from the soil at z = 0."""
    random = Weyl(seed)
    plant = tube(
        [(0, 0, -0.03), (0.015, 0.01, height * 0.4), (-0.01, 0.02, height * 0.8)],
        [0.013, 0.01, 0.006],
        7,
    )
    plant.merge(
        tube(
            [(0.02, -0.02, -0.03), (0.05, -0.05, height * 0.3), (0.07, -0.03, height * 0.62)],
            [0.01, 0.008, 0.005],
            7,
        )
    )
    for i in range(leaves):
        z = height * (0.22 + 0.66 * i / leaves)
        blade = leaf(0.2 + 0.13 * random(), 0.1 + 0.05 * random(), 0.5 + 0.5 * random())
        plant.merge(
            blade,
            (0.02 * random(), 0.02 * random(), z),
            turned(137.5 * i, -18 + 30 * random() - 28 * i / leaves),
        )
    return plant


def sword_plant(seed=5, leaves=11):
    random = Weyl(seed)
    plant = Solid()
    for i in range(leaves):
        length, width, lean = 0.36 + 0.3 * random(), 0.05 + 0.02 * random(), 0.1 + 0.22 * random()

        def point(u, v, length=length, width=width, lean=lean):
            half = width / 2 * (1 - u**3) * (0.7 + 0.6 * u)
            return length * lean * u * u + 0.02, half * (2 * v - 1), length * u - 0.02

        plant.merge(
            sheet(3, 6, lambda u, v: point(0.98 * u, v), 0.004),
            (0.02 * random(), 0.02 * random(), 0),
            turned(137.5 * i),
        )
    return plant


def tulips(seed=7, flowers=7):
    """Stems and leaves, and heads apart: two files, two colours."""
    random, stems, heads = Weyl(seed), Solid(), Solid()
    for i in range(flowers):
        phi, lean, height = (
            math.radians(137.5 * i),
            0.03 + 0.09 * i / flowers,
            0.36 + 0.08 * random(),
        )
        top = np.array((lean * math.cos(phi), lean * math.sin(phi), height))
        stems.merge(tube([(0, 0, 0.08), 0.35 * top + (0, 0, 0.05), top], 0.003, 5))
        bud = lathe(
            [(0, -0.004), (0.014, 0.004), (0.019, 0.02), (0.016, 0.04), (0.009, 0.052), (0, 0.044)],
            10,
        )
        heads.merge(bud, top)
        if i % 2:
            stems.merge(leaf(0.2, 0.03, 0.6), (0, 0, 0.2), turned(137.5 * i + 60, -35))
    return stems, heads
