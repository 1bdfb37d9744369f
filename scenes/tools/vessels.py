# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Meshes of what is turned: cups, bottles, bowls, pots, lamp shades, taps."""

import math

import numpy as np

from solid import lathe, tube


def mug(radius, height, wall=0.0035):
    """A cup 3.5 mm thick, with a handle towards +x."""
    body = lathe(
        [
            (0, 0),
            (radius - 0.004, 0),
            (radius, 0.004),
            (radius, height),
            (radius - wall, height),
            (radius - wall, 0.008),
            (0, 0.008),
        ],
        24,
    )
    bow = [
        (radius - 0.002 + 0.029 * math.sin(a), 0, height * 0.52 - 0.031 * math.cos(a))
        for a in np.linspace(0.12, math.pi - 0.12, 9)
    ]
    return body.merge(tube(bow, 0.0048, 8))


def bowl(radius, height, wall=0.005):
    outside = [(0.45 * radius, 0)] + [
        (radius * (0.45 + 0.55 * math.sin(t)), height * (1 - math.cos(t)))
        for t in np.linspace(0.15, math.pi / 2, 6)
    ]
    inside = [(max(0.0, r - wall), max(z, wall)) for r, z in reversed(outside)]
    return lathe([(0, 0)] + outside + inside + [(0, wall)], 28)


def plate():
    return lathe(
        [
            (0, 0),
            (0.07, 0),
            (0.122, 0.013),
            (0.123, 0.017),
            (0.118, 0.017),
            (0.075, 0.006),
            (0, 0.006),
        ],
        28,
    )


def wine_bottle():
    return lathe(
        [
            (0, 0),
            (0.034, 0),
            (0.0375, 0.004),
            (0.0375, 0.19),
            (0.035, 0.205),
            (0.026, 0.222),
            (0.0165, 0.236),
            (0.0145, 0.25),
            (0.0145, 0.292),
            (0.0165, 0.292),
            (0.0165, 0.303),
            (0, 0.303),
        ],
        20,
    )


def water_bottle():
    return lathe(
        [
            (0, 0),
            (0.037, 0),
            (0.041, 0.006),
            (0.041, 0.07),
            (0.038, 0.085),
            (0.038, 0.1),
            (0.041, 0.115),
            (0.041, 0.185),
            (0.036, 0.21),
            (0.022, 0.235),
            (0.014, 0.245),
            (0.014, 0.255),
            (0.0175, 0.255),
            (0.0175, 0.274),
            (0, 0.274),
        ],
        20,
    )


def soap_bottle():
    body = lathe(
        [
            (0, 0),
            (0.031, 0),
            (0.034, 0.004),
            (0.034, 0.12),
            (0.028, 0.137),
            (0.011, 0.145),
            (0.011, 0.165),
            (0.004, 0.165),
            (0.004, 0.19),
            (0, 0.19),
        ],
        18,
    )
    return body.merge(tube([(-0.012, 0, 0.19), (0.02, 0, 0.19), (0.04, 0, 0.182)], 0.006, 8))


def vase():
    outside = [
        (0.045, 0),
        (0.062, 0.03),
        (0.078, 0.08),
        (0.08, 0.12),
        (0.066, 0.17),
        (0.042, 0.21),
        (0.034, 0.235),
        (0.043, 0.262),
    ]
    inside = [
        (0.037, 0.262),
        (0.028, 0.235),
        (0.036, 0.21),
        (0.058, 0.17),
        (0.07, 0.1),
        (0.05, 0.02),
    ]
    return lathe([(0, 0)] + outside + inside + [(0, 0.02)], 24)


def flower_pot(radius, height):
    rim = 0.012
    return lathe(
        [
            (0, 0),
            (0.72 * radius, 0),
            (0.95 * radius, height - 0.05),
            (radius, height - 0.05),
            (radius, height),
            (radius - rim, height),
            (radius - rim, height - 0.03),
            (0, height - 0.03),
        ],
        26,
    )


def lamp_shade(bottom, top, height):
    """Open at both ends, 3 mm of cloth."""
    t = 0.003
    return lathe([(bottom, 0), (top, height), (top - t, height), (bottom - t, 0), (bottom, 0)], 28)


def lamp_foot():
    return lathe(
        [
            (0, 0),
            (0.065, 0),
            (0.07, 0.008),
            (0.06, 0.02),
            (0.062, 0.05),
            (0.075, 0.09),
            (0.07, 0.13),
            (0.04, 0.17),
            (0.016, 0.19),
            (0.012, 0.26),
            (0, 0.26),
        ],
        20,
    )


def kettle():
    body = lathe(
        [
            (0, 0),
            (0.082, 0),
            (0.088, 0.008),
            (0.086, 0.06),
            (0.072, 0.13),
            (0.055, 0.165),
            (0.05, 0.172),
            (0.025, 0.183),
            (0.012, 0.186),
            (0.014, 0.2),
            (0.008, 0.207),
            (0, 0.207),
        ],
        24,
    )
    body.merge(
        tube(
            [
                (-0.05, 0, 0.165),
                (-0.09, 0, 0.185),
                (-0.125, 0, 0.16),
                (-0.13, 0, 0.1),
                (-0.11, 0, 0.045),
                (-0.08, 0, 0.035),
            ],
            0.011,
            8,
        )
    )
    return body.merge(
        tube([(0.07, 0, 0.09), (0.1, 0, 0.115), (0.125, 0, 0.155)], [0.022, 0.016, 0.012], 8)
    )


def pot():
    body = lathe(
        [
            (0, 0),
            (0.1, 0),
            (0.107, 0.008),
            (0.107, 0.12),
            (0.111, 0.122),
            (0.108, 0.128),
            (0.06, 0.142),
            (0.012, 0.146),
            (0.01, 0.16),
            (0.02, 0.168),
            (0.018, 0.176),
            (0, 0.178),
        ],
        26,
    )
    for side in (1, -1):
        ear = [
            (0.1, side * -0.035, 0.095),
            (0.137, side * -0.03, 0.097),
            (0.142, 0, 0.098),
            (0.137, side * 0.03, 0.097),
            (0.1, side * 0.035, 0.095),
        ]
        body.merge(tube([(side * x, y, z) for x, y, z in ear], 0.006, 6))
    return body


def pan():
    body = lathe(
        [
            (0, 0),
            (0.105, 0),
            (0.128, 0.042),
            (0.131, 0.045),
            (0.126, 0.045),
            (0.103, 0.006),
            (0, 0.006),
        ],
        26,
    )
    return body.merge(
        tube([(0.12, 0, 0.034), (0.2, 0, 0.052), (0.31, 0, 0.062)], [0.008, 0.011, 0.012], 8)
    )


def basket():
    outside = [(0.15, 0), (0.17, 0.15), (0.187, 0.3), (0.197, 0.43), (0.206, 0.434), (0.206, 0.46)]
    inside = [(0.19, 0.46), (0.175, 0.3), (0.14, 0.015)]
    return lathe([(0, 0)] + outside + inside + [(0, 0.015)], 26)


def tap(reach, height):
    """A bent pipe towards +x, with a lever."""
    path = [(0, 0, 0), (0, 0, height - 0.05)]
    path += [
        (reach / 2 - reach / 2 * math.cos(a), 0, height - 0.05 + 0.05 * math.sin(a))
        for a in np.linspace(0.3, math.pi, 8)
    ]
    path += [(reach, 0, height - 0.085)]
    body = tube(path, 0.0115, 10)
    body.merge(lathe([(0, 0), (0.024, 0), (0.024, 0.045), (0, 0.045)], 14))
    return body.merge(tube([(0, 0.02, 0.03), (0, 0.055, 0.045), (0.01, 0.09, 0.075)], 0.007, 8))
