#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Draws the surfaces of the homes into scenes/textures: small PNG files, 8-bit RGB. Grey ones take the colour of their material."""

import pathlib
import struct
import sys
import zlib

import numpy as np


def noise(height, width, cell, seed):
    """Smooth values in 0..1 that tile, from whole-number hashes."""
    rows, columns = max(1, height // cell[0]), max(1, width // cell[1])
    index = np.arange(rows * columns, dtype=np.uint64) + np.uint64(seed * 1000003)
    index = (index ^ (index >> np.uint64(7))) * np.uint64(2654435761) % np.uint64(1 << 32)
    index = (index ^ (index >> np.uint64(15))) * np.uint64(2246822519) % np.uint64(1 << 32)
    lattice = ((index ^ (index >> np.uint64(13))) % np.uint64(4096)).astype(float).reshape(rows, columns) / 4095
    y, x = np.arange(height) * rows / height, np.arange(width) * columns / width
    i, j = y.astype(int), x.astype(int)
    a, b = (y - i)[:, None], (x - j)[None, :]
    a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
    at = lambda di, dj: lattice[(i + di) % rows][:, (j + dj) % columns]
    return (at(0, 0) * (1 - a) + at(1, 0) * a) * (1 - b) + (at(0, 1) * (1 - a) + at(1, 1) * a) * b


def tinted(value, colour):
    return value[..., None] * np.array(colour, float)


def grain(size=128, seed=1):
    """Wood, grey, its grain along the rows."""
    wave = noise(size, size, (16, 64), seed)
    lines = noise(size, size, (2, 64), seed + 1)
    return tinted(0.86 + 0.1 * lines - 0.12 * (np.abs((wave * 6) % 1 - 0.5) < 0.1) * lines, (1, 1, 1))


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
        image[k * board:(k + 1) * board] = part
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
    return tinted(0.84 + 0.08 * ((x // 2 + y // 2) % 2) + 0.08 * noise(size, size, (1, 1), 41), (1, 1, 1))


def stone(size=128):
    return tinted(0.6 + 0.25 * noise(size, size, (8, 8), 51) + 0.3 * (noise(size, size, (1, 1), 52) - 0.5), (1, 1, 1))


def rug(size=192):
    """A carpet with borders and a diamond field."""
    y, x = np.mgrid[0:size, 0:size]
    edge = np.minimum(np.minimum(x, size - 1 - x), np.minimum(y, size - 1 - y))
    field = (np.abs((x - y) % 32 - 16) + np.abs((x + y) % 32 - 16)) % 32
    palette = np.array([(0.55, 0.15, 0.13), (0.83, 0.74, 0.58), (0.17, 0.23, 0.36), (0.70, 0.36, 0.22)])
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
    return tinted(0.86 + 0.1 * (np.abs(x % 16 - 8) < 2) + 0.04 * noise(size, size, (1, 1), 71), (1, 1, 1))


def checks(size=128):
    """Bed linen."""
    y, x = np.mgrid[0:size, 0:size]
    dark = ((x % 32) < 10).astype(int) + ((y % 32) < 10).astype(int)
    return np.array([(0.90, 0.90, 0.88), (0.64, 0.72, 0.80), (0.40, 0.52, 0.65)])[dark] * (0.95 + 0.05 * noise(size, size, (1, 1), 81))[..., None]


def spine(size=64):
    """The back of a book, grey: bands and a block of title."""
    y, x = np.mgrid[0:size, 0:size]
    value = np.full((size, size), 0.9)
    value[(y % size < 6) | (y > size - 7)] = 0.62
    value[(np.abs(y - 12) < 2) | (np.abs(y - 51) < 2)] = 1.0
    title = (np.abs(x - 32) < 14) & (y > 20) & (y < 42) & ((y // 3) % 2 == 0)
    value[title] = 1.0
    return tinted(value, (1, 1, 1))


def hills(width, height, seed, sky, far, near):
    """A landscape: sky, a far ridge, a near meadow."""
    y, x = np.mgrid[0:height, 0:width] / height
    image = np.array(sky[0]) + (np.array(sky[1]) - np.array(sky[0])) * y[..., None] * 1.6
    cloud = noise(height, width, (height // 6, width // 4), seed) * (y < 0.5)
    image = np.where((cloud > 0.62)[..., None], 0.5 * image + 0.5 * np.array((0.97, 0.97, 0.98)), image)
    ridge = 0.42 + 0.16 * noise(1, width, (1, width // 6), seed + 1) + 0.05 * noise(1, width, (1, width // 16), seed + 2)
    meadow = 0.66 + 0.1 * noise(1, width, (1, width // 3), seed + 3)
    shade = (0.85 + 0.3 * noise(height, width, (4, 4), seed + 4))[..., None]
    image = np.where((y > ridge)[..., None], np.array(far) * shade, image)
    return np.where((y > meadow)[..., None], np.array(near) * shade * (1.2 - 0.4 * y[..., None]), image)


def garden(width=192, height=128):
    """What stands outside the windows: sky, trees, a hedge and a lawn."""
    image = hills(width, height, 91, ((0.50, 0.72, 0.95), (0.90, 0.95, 1.0)), (0.36, 0.52, 0.30), (0.45, 0.66, 0.28))
    y, x = np.mgrid[0:height, 0:width]
    for k, (cx, cy, r) in enumerate(((30, 62, 26), (70, 74, 17), (120, 66, 24), (168, 58, 30))):
        crown = np.hypot(x - cx, (y - cy) * 1.1) < r * (0.8 + 0.4 * noise(height, width, (8, 8), 95 + k))
        trunk = (np.abs(x - cx) < 3) & (y > cy) & (y < cy + r + 14)
        image = np.where(trunk[..., None], np.array((0.34, 0.25, 0.17)), image)
        image = np.where(crown[..., None], np.array((0.22, 0.42, 0.18)) * (0.7 + 0.6 * noise(height, width, (4, 4), 99 + k))[..., None], image)
    return image


def abstract(width=96, height=128):
    """A painting of coloured fields."""
    y, x = np.mgrid[0:height, 0:width]
    image = np.full((height, width, 3), 0.93)
    for (x0, y0, x1, y1), colour in (((8, 10, 60, 70), (0.83, 0.30, 0.20)), ((36, 48, 88, 118), (0.16, 0.34, 0.50)),
                                     ((14, 80, 50, 112), (0.93, 0.72, 0.22)), ((66, 12, 84, 40), (0.15, 0.15, 0.16))):
        image = np.where(((x >= x0) & (x < x1) & (y >= y0) & (y < y1))[..., None], np.array(colour), image)
    disc = np.hypot(x - 62, y - 34) < 15
    return np.where(disc[..., None], np.array((0.96, 0.86, 0.62)), image)


def portrait(width=96, height=128):
    """A dark vase with flowers on pale ground, for a bedroom."""
    y, x = np.mgrid[0:height, 0:width]
    image = np.where((y > 92)[..., None], np.array((0.62, 0.47, 0.34)), np.array((0.88, 0.86, 0.78)))
    pot = (np.hypot((x - 48) / 17, (y - 88) / 22) < 1) & (y > 68)
    image = np.where(pot[..., None], np.array((0.16, 0.28, 0.42)), image)
    for k in range(16):
        cx, cy = 48 + 26 * np.sin(k * 2.4) * (0.4 + k / 26), 44 - 20 * np.cos(k * 2.4) * (0.4 + k / 26)
        stem = (np.abs(x - (48 + (cx - 48) * (70 - y) / (70 - cy))) < 1) & (y < 70) & (y > cy)
        image = np.where(stem[..., None], np.array((0.25, 0.42, 0.22)), image)
        flower = np.array(((0.80, 0.22, 0.30), (0.95, 0.75, 0.30), (0.90, 0.88, 0.92), (0.70, 0.40, 0.62)))[k % 4]
        image = np.where((np.hypot(x - cx, y - cy) < 6)[..., None], flower, image)
    return image


def desktop(width=160, height=100):
    """A computer's screen: windows with lines of text."""
    image = hills(width, height, 121, ((0.10, 0.20, 0.42), (0.45, 0.45, 0.62)), (0.20, 0.20, 0.38), (0.10, 0.10, 0.22))
    y, x = np.mgrid[0:height, 0:width]
    for x0, y0, x1, y1 in ((12, 10, 92, 78), (78, 28, 150, 90)):
        inside = (x >= x0) & (x < x1) & (y >= y0) & (y < y1)
        text = inside & (y > y0 + 9) & (y % 5 < 2) & (x > x0 + 4) & (x < x1 - 6 - (y * 7) % 30)
        image = np.where(inside[..., None], np.where((y < y0 + 6)[..., None], np.array((0.30, 0.42, 0.62)), 0.95), image)
        image = np.where(text[..., None], 0.35, image)
    return image


def clock(size=96):
    y, x = np.mgrid[0:size, 0:size] - size / 2 + 0.5
    image = np.full((size, size, 3), 0.95)
    turn = np.degrees(np.arctan2(x, -y)) % 30
    mark = (np.hypot(x, y) > 36) & (np.hypot(x, y) < 43) & ((turn < 3) | (turn > 27))
    along = lambda deg, length: (np.abs(x * np.cos(np.radians(deg)) + y * np.sin(np.radians(deg))) < 1.6) & (
        (x * np.sin(np.radians(deg)) - y * np.cos(np.radians(deg))) * 2 > -6) & (x * np.sin(np.radians(deg)) - y * np.cos(np.radians(deg)) < length)
    return np.where((mark | along(305, 22) | along(50, 34))[..., None], 0.12, image)


def all_textures():
    return {
        "grain": grain(), "planks": planks(), "tiles_floor": tiles(128, 2, (0.80, 0.79, 0.76), (0.55, 0.54, 0.52), 11),
        "tiles_wall": tiles(128, 4, (0.93, 0.95, 0.95), (0.76, 0.78, 0.78), 12), "tiles_blue": tiles(128, 4, (0.50, 0.66, 0.72), (0.82, 0.85, 0.85), 13),
        "carpet": carpet(), "weave": weave(), "stone": stone(), "rug": rug(), "stripes": stripes(), "checks": checks(), "spine": spine(),
        "garden": garden(), "landscape": hills(160, 96, 111, ((0.95, 0.62, 0.35), (0.98, 0.88, 0.62)), (0.38, 0.36, 0.52), (0.30, 0.42, 0.30)),
        "film": hills(160, 90, 131, ((0.16, 0.36, 0.70), (0.70, 0.86, 0.98)), (0.42, 0.46, 0.60), (0.20, 0.50, 0.58)),
        "abstract": abstract(), "portrait": portrait(), "desktop": desktop(), "clock": clock(),
    }


def png_bytes(image):
    """PNG with every row filtered by its left neighbour (type 1)."""
    rgb = np.clip(np.floor(image * 255 + 0.5 + 1e-7), 0, 255).astype(np.uint8)
    height, width, _ = rgb.shape
    left = np.concatenate([np.zeros((height, 1, 3), np.uint8), rgb[:, :-1]], axis=1)
    rows = np.concatenate([np.ones((height, 1), np.uint8), (rgb - left).reshape(height, -1)], axis=1)
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b"")


def write_all(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, image in all_textures().items():
        (folder / f"{name}.png").write_bytes(png_bytes(image))


if __name__ == "__main__":
    write_all(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "textures")
