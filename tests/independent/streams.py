# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Named random streams by docs/methods.md: SplitMix64, uniforms, normals by Box-Muller, Beta variates."""

import math

import numpy as np

ALL = (1 << 64) - 1
G = 0x9e3779b97f4a7c15


def mix(x):
    """Of a whole number, or of each word of an array of uint64, whose arithmetic is modulo 2^64 by itself."""
    first, second = 0xbf58476d1ce4e5b9, 0x94d049bb133111eb
    if isinstance(x, np.ndarray):
        thirty, other, last = np.uint64(30), np.uint64(27), np.uint64(31)
        x = (x ^ (x >> thirty)) * np.uint64(first)
        x = (x ^ (x >> other)) * np.uint64(second)
        return x ^ (x >> last)
    x = (x ^ (x >> 30)) * first & ALL
    x = (x ^ (x >> 27)) * second & ALL
    return x ^ (x >> 31)


class Stream:
    def __init__(self, seed, purpose, *indices):
        self.state, self.kept = mix((seed + G) & ALL), []
        name = purpose.encode()
        for part in (*name, len(name), *indices):
            self.state = (mix(self.state ^ mix((int(part) + G) & ALL)) + G) & ALL

    def skip(self, count):
        """Passes over so many words."""
        self.state = (self.state + int(count) * G) & ALL
        return self

    def words(self, count):
        steps = np.arange(1, count + 1, dtype=np.uint64) * np.uint64(G) + np.uint64(self.state)
        self.skip(count)
        return mix(steps)

    def uniforms(self, count):
        return (self.words(count) >> np.uint64(11)).astype(float) * 2.0**-53

    def normals(self, count):
        taken, pairs = self.kept[:count], max(0, count - len(self.kept) + 1) // 2
        u = self.uniforms(2 * pairs).reshape(pairs, 2)
        size, angle = np.sqrt(-2 * np.log(1 - u[:, 0])), 2 * np.pi * u[:, 1]
        made = np.stack([size * np.cos(angle), size * np.sin(angle)], axis=-1).reshape(-1)
        rest = count - len(taken)
        self.kept = self.kept[len(taken):] + made[rest:].tolist()
        return np.concatenate([taken, made[:rest]])

    def uniform(self):
        return float(self.uniforms(1)[0])

    def normal(self):
        return float(self.normals(1)[0])

    def gamma(self, shape):
        """Marsaglia and Tsang (2000)."""
        if shape < 1:
            u = self.uniform()
            return (1 - u)**(1 / shape) * self.gamma(shape + 1)
        d = shape - 1 / 3
        while True:
            n = self.normal()
            u = self.uniform()
            v = (1 + n / math.sqrt(9 * d))**3
            if v > 0 and math.log(1 - u) < n * n / 2 + d - d * v + d * math.log(v):
                return d * v

    def beta(self, a, b):
        if b == 0 or a == 0:
            return 1.0 if b == 0 else 0.0
        x = self.gamma(a)
        return x / (x + self.gamma(b))


def trial_seed(study_seed, repetition=0):
    """The seed of all streams of a repetition."""
    return int(Stream(study_seed, "trial", repetition).words(1)[0])
