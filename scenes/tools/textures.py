#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Draws the surfaces of the homes into scenes/textures: small PNG files, 8-bit RGB.

Grey ones take the colour of their material.
"""

import pathlib
import sys

import numpy as np

from pictures import abstract, clock, desktop, garden, hills, portrait
from raster import noise, png_bytes, tinted


def grain(size=128, seed=1):
    """Wood, grey, its grain along the rows."""
    wave = noise(size, size, (16, 64), seed)
    lines = noise(size, size, (2, 64), seed + 1)
    return tinted(
        0.86 + 0.1 * lines - 0.12 * (np.abs((wave * 6) % 1 - 0.5) < 0.1) * lines, (1, 1, 1)
    )


def planks(size=256):
    """Boards along x, eight of them, a joint in each."""
    image = np.zeros((size, size, 3))
    board = size // 8
    for k in range(8):
        tone = 0.86 + 0.16 * ((k * 5) % 8) / 8
        part = tinted(tone * (0.9 + 0.1 * noise(board, size, (2, 64), 20 + k)), (0.72, 0.53, 0.35))
        part[0] *= 0.55
        joint = (k * 97) % size
        part[:, joint] *= 0.6
        part = np.where((np.arange(size) < joint)[None, :, None], part * 0.93, part)
        image[k * board : (k + 1) * board] = part
    return image


def tiles(size, count, colour, grout, seed, width=2):
    """count x count tiles with grout."""
    cell = size // count
    y, x = np.mgrid[0:size, 0:size]
    tone = noise(size, size, (cell, cell), seed)[(y // cell) * cell, (x // cell) * cell]
    body = tinted(0.92 + 0.08 * tone, colour)
    joint = ((y % cell) < width) | ((x % cell) < width)
    return np.where(joint[..., None], np.array(grout, float), body)


def carpet(size=128):
    fine, coarse = noise(size, size, (1, 1), 31), noise(size, size, (16, 16), 32)
    return tinted(0.78 + 0.18 * fine + 0.06 * coarse, (0.74, 0.70, 0.66))


def weave(size=64):
    """Cloth, grey."""
    y, x = np.mgrid[0:size, 0:size]
    return tinted(
        0.84 + 0.08 * ((x // 2 + y // 2) % 2) + 0.08 * noise(size, size, (1, 1), 41), (1, 1, 1)
    )


def stone(size=128):
    return tinted(
        0.6 + 0.25 * noise(size, size, (8, 8), 51) + 0.3 * (noise(size, size, (1, 1), 52) - 0.5),
        (1, 1, 1),
    )


def rug(size=192):
    """A carpet with borders and a diamond field."""
    y, x = np.mgrid[0:size, 0:size]
    edge = np.minimum(np.minimum(x, size - 1 - x), np.minimum(y, size - 1 - y))
    field = (np.abs((x - y) % 32 - 16) + np.abs((x + y) % 32 - 16)) % 32
    palette = np.array(
        [(0.55, 0.15, 0.13), (0.83, 0.74, 0.58), (0.17, 0.23, 0.36), (0.70, 0.36, 0.22)]
    )
    choice = np.where(field < 7, 1, np.where(field < 14, 2, 0))
    middle = np.hypot(x - size / 2 + 0.5, y - size / 2 + 0.5)
    choice = np.where(middle < 0.24 * size, np.where((middle // 7) % 2 == 0, 3, 1), choice)
    choice = np.where(edge < 26, 0, choice)
    for lo, hi, c in ((0, 3, 1), (7, 11, 2), (15, 17, 1), (22, 26, 2)):
        choice = np.where((edge >= lo) & (edge < hi), c, choice)
    return palette[choice] * (0.9 + 0.1 * noise(size, size, (1, 1), 61))[..., None]


def stripes(size=64):
    """Cloth of a curtain or a towel, grey."""
    x = np.mgrid[0:size, 0:size][1]
    return tinted(
        0.86 + 0.1 * (np.abs(x % 16 - 8) < 2) + 0.04 * noise(size, size, (1, 1), 71), (1, 1, 1)
    )


def checks(size=128):
    """Bed linen."""
    y, x = np.mgrid[0:size, 0:size]
    dark = ((x % 32) < 10).astype(int) + ((y % 32) < 10).astype(int)
    return (
        np.array([(0.90, 0.90, 0.88), (0.64, 0.72, 0.80), (0.40, 0.52, 0.65)])[dark]
        * (0.95 + 0.05 * noise(size, size, (1, 1), 81))[..., None]
    )


def spine(size=64):
    """The back of a book, grey: bands and a block of title."""
    y, x = np.mgrid[0:size, 0:size]
    value = np.full((size, size), 0.9)
    value[(y % size < 6) | (y > size - 7)] = 0.62
    value[(np.abs(y - 12) < 2) | (np.abs(y - 51) < 2)] = 1.0
    title = (np.abs(x - 32) < 14) & (y > 20) & (y < 42) & ((y // 3) % 2 == 0)
    value[title] = 1.0
    return tinted(value, (1, 1, 1))


def all_textures():
    return {
        "grain": grain(),
        "planks": planks(),
        "tiles_floor": tiles(128, 2, (0.80, 0.79, 0.76), (0.55, 0.54, 0.52), 11),
        "tiles_wall": tiles(128, 4, (0.93, 0.95, 0.95), (0.76, 0.78, 0.78), 12),
        "tiles_blue": tiles(128, 4, (0.50, 0.66, 0.72), (0.82, 0.85, 0.85), 13),
        "carpet": carpet(),
        "weave": weave(),
        "stone": stone(),
        "rug": rug(),
        "stripes": stripes(),
        "checks": checks(),
        "spine": spine(),
        "garden": garden(),
        "landscape": hills(
            160,
            96,
            111,
            ((0.95, 0.62, 0.35), (0.98, 0.88, 0.62)),
            (0.38, 0.36, 0.52),
            (0.30, 0.42, 0.30),
        ),
        "film": hills(
            160,
            90,
            131,
            ((0.16, 0.36, 0.70), (0.70, 0.86, 0.98)),
            (0.42, 0.46, 0.60),
            (0.20, 0.50, 0.58),
        ),
        "abstract": abstract(),
        "portrait": portrait(),
        "desktop": desktop(),
        "clock": clock(),
    }


def write_all(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, image in all_textures().items():
        (folder / f"{name}.png").write_bytes(png_bytes(image))


if __name__ == "__main__":
    write_all(
        pathlib.Path(sys.argv[1])
        if len(sys.argv) > 1
        else pathlib.Path(__file__).resolve().parent.parent / "textures"
    )
