# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Noise, and PNG files without a library."""

import struct
import zlib

import numpy as np


def noise(height, width, cell, seed):
    """Smooth values in 0..1 that tile, from whole-number hashes."""
    rows, columns = max(1, height // cell[0]), max(1, width // cell[1])
    index = np.arange(rows * columns, dtype=np.uint64) + np.uint64(seed * 1000003)
    index = (index ^ (index >> np.uint64(7))) * np.uint64(2654435761) % np.uint64(1 << 32)
    index = (index ^ (index >> np.uint64(15))) * np.uint64(2246822519) % np.uint64(1 << 32)
    lattice = ((index ^ (index >> np.uint64(13))) % np.uint64(4096)).astype(float).reshape(
        rows, columns
    ) / 4095
    y, x = np.arange(height) * rows / height, np.arange(width) * columns / width
    i, j = y.astype(int), x.astype(int)
    a, b = (y - i)[:, None], (x - j)[None, :]
    a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
    at = lambda di, dj: lattice[(i + di) % rows][:, (j + dj) % columns]
    return (at(0, 0) * (1 - a) + at(1, 0) * a) * (1 - b) + (at(0, 1) * (1 - a) + at(1, 1) * a) * b


def tinted(value, colour):
    return value[..., None] * np.array(colour, float)


def png_bytes(image):
    """PNG with every row filtered by its left neighbour (type 1)."""
    rgb = np.clip(np.floor(image * 255 + 0.5 + 1e-7), 0, 255).astype(np.uint8)
    height, width, _ = rgb.shape
    left = np.concatenate([np.zeros((height, 1, 3), np.uint8), rgb[:, :-1]], axis=1)
    rows = np.concatenate(
        [np.ones((height, 1), np.uint8), (rgb - left).reshape(height, -1)], axis=1
    )
    chunk = (
        lambda name, data: struct.pack(">I", len(data))
        + name
        + data
        + struct.pack(">I", zlib.crc32(name + data))
    )
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + chunk(b"IEND", b"")
    )
