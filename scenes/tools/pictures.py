# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Pictures: paintings, screens, the garden before the windows, a clock's face.

Rows from the top, RGB in 0..1.
"""

import numpy as np

from raster import noise


def hills(width, height, seed, sky, far, near):
    """A landscape: sky, a far ridge, a near meadow."""
    y, x = np.mgrid[0:height, 0:width] / height
    image = np.array(sky[0]) + (np.array(sky[1]) - np.array(sky[0])) * y[..., None] * 1.6
    cloud = noise(height, width, (height // 6, width // 4), seed) * (y < 0.5)
    image = np.where(
        (cloud > 0.62)[..., None], 0.5 * image + 0.5 * np.array((0.97, 0.97, 0.98)), image
    )
    ridge = (
        0.42
        + 0.16 * noise(1, width, (1, width // 6), seed + 1)
        + 0.05 * noise(1, width, (1, width // 16), seed + 2)
    )
    meadow = 0.66 + 0.1 * noise(1, width, (1, width // 3), seed + 3)
    shade = (0.85 + 0.3 * noise(height, width, (4, 4), seed + 4))[..., None]
    image = np.where((y > ridge)[..., None], np.array(far) * shade, image)
    return np.where(
        (y > meadow)[..., None], np.array(near) * shade * (1.2 - 0.4 * y[..., None]), image
    )


def garden(width=192, height=128):
    """What stands outside the windows: sky, trees, a hedge and a lawn."""
    image = hills(
        width,
        height,
        91,
        ((0.50, 0.72, 0.95), (0.90, 0.95, 1.0)),
        (0.36, 0.52, 0.30),
        (0.45, 0.66, 0.28),
    )
    y, x = np.mgrid[0:height, 0:width]
    for k, (cx, cy, r) in enumerate(((30, 62, 26), (70, 74, 17), (120, 66, 24), (168, 58, 30))):
        crown = np.hypot(x - cx, (y - cy) * 1.1) < r * (
            0.8 + 0.4 * noise(height, width, (8, 8), 95 + k)
        )
        trunk = (np.abs(x - cx) < 3) & (y > cy) & (y < cy + r + 14)
        image = np.where(trunk[..., None], np.array((0.34, 0.25, 0.17)), image)
        image = np.where(
            crown[..., None],
            np.array((0.22, 0.42, 0.18))
            * (0.7 + 0.6 * noise(height, width, (4, 4), 99 + k))[..., None],
            image,
        )
    return image


def abstract(width=96, height=128):
    """A painting of coloured fields."""
    y, x = np.mgrid[0:height, 0:width]
    image = np.full((height, width, 3), 0.93)
    for (x0, y0, x1, y1), colour in (
        ((8, 10, 60, 70), (0.83, 0.30, 0.20)),
        ((36, 48, 88, 118), (0.16, 0.34, 0.50)),
        ((14, 80, 50, 112), (0.93, 0.72, 0.22)),
        ((66, 12, 84, 40), (0.15, 0.15, 0.16)),
    ):
        image = np.where(
            ((x >= x0) & (x < x1) & (y >= y0) & (y < y1))[..., None], np.array(colour), image
        )
    disc = np.hypot(x - 62, y - 34) < 15
    return np.where(disc[..., None], np.array((0.96, 0.86, 0.62)), image)


def portrait(width=96, height=128):
    """A dark vase with flowers on pale ground, for a bedroom."""
    y, x = np.mgrid[0:height, 0:width]
    image = np.where(
        (y > 92)[..., None], np.array((0.62, 0.47, 0.34)), np.array((0.88, 0.86, 0.78))
    )
    pot = (np.hypot((x - 48) / 17, (y - 88) / 22) < 1) & (y > 68)
    image = np.where(pot[..., None], np.array((0.16, 0.28, 0.42)), image)
    for k in range(16):
        cx, cy = 48 + 26 * np.sin(k * 2.4) * (0.4 + k / 26), 44 - 20 * np.cos(k * 2.4) * (
            0.4 + k / 26
        )
        stem = (np.abs(x - (48 + (cx - 48) * (70 - y) / (70 - cy))) < 1) & (y < 70) & (y > cy)
        image = np.where(stem[..., None], np.array((0.25, 0.42, 0.22)), image)
        flower = np.array(
            ((0.80, 0.22, 0.30), (0.95, 0.75, 0.30), (0.90, 0.88, 0.92), (0.70, 0.40, 0.62))
        )[k % 4]
        image = np.where((np.hypot(x - cx, y - cy) < 6)[..., None], flower, image)
    return image


def desktop(width=160, height=100):
    """A computer's screen: windows with lines of text."""
    image = hills(
        width,
        height,
        121,
        ((0.10, 0.20, 0.42), (0.45, 0.45, 0.62)),
        (0.20, 0.20, 0.38),
        (0.10, 0.10, 0.22),
    )
    y, x = np.mgrid[0:height, 0:width]
    for x0, y0, x1, y1 in ((12, 10, 92, 78), (78, 28, 150, 90)):
        inside = (x >= x0) & (x < x1) & (y >= y0) & (y < y1)
        text = inside & (y > y0 + 9) & (y % 5 < 2) & (x > x0 + 4) & (x < x1 - 6 - (y * 7) % 30)
        image = np.where(
            inside[..., None],
            np.where((y < y0 + 6)[..., None], np.array((0.30, 0.42, 0.62)), 0.95),
            image,
        )
        image = np.where(text[..., None], 0.35, image)
    return image


def clock(size=96):
    y, x = np.mgrid[0:size, 0:size] - size / 2 + 0.5
    image = np.full((size, size, 3), 0.95)
    turn = np.degrees(np.arctan2(x, -y)) % 30
    mark = (np.hypot(x, y) > 36) & (np.hypot(x, y) < 43) & ((turn < 3) | (turn > 27))
    along = (
        lambda deg, length: (
            np.abs(x * np.cos(np.radians(deg)) + y * np.sin(np.radians(deg))) < 1.6
        )
        & ((x * np.sin(np.radians(deg)) - y * np.cos(np.radians(deg))) * 2 > -6)
        & (x * np.sin(np.radians(deg)) - y * np.cos(np.radians(deg)) < length)
    )
    return np.where((mark | along(305, 22) | along(50, 34))[..., None], 0.12, image)
