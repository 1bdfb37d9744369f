# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Masks, classes and scores as a network would have given them, by docs/methods.md."""

import math

import numpy as np
from scipy.ndimage import distance_transform_edt

from streams import Stream

SHARES = ("miss", "confusion", "scores", "holes", "islands")
DOSES = ("boundary_px", "ragged_px", *SHARES)
DEFAULTS = {**dict.fromkeys(DOSES, 0), "scale": 1, "ragged_length_px": 8, "miss_area_px": 1024, "disc_radius_px": 3,
            "island_reach_px": 20, "score_concentration": 10, "confusion_matrix": [], "score_mean": None}
PRESETS = {"ideal": {}, "typical": {"ragged_px": 1.5, "miss": 0.5, "confusion": 0.05, "scores": 1, "holes": 0.01,
                                    "islands": 0.005}}
MIDDLE = 1 << 20  # number of row and column 0, since discs may be centred beyond the image


def dose_of(keys):
    """All keys of faults.labels, from those that a study gives."""
    dose = {**DEFAULTS, **PRESETS[keys.get("preset", "ideal")], **keys}
    scaled = {name: dose["scale"] * dose[name] for name in DOSES}
    return {**dose, **scaled, **{name: min(1, scaled[name]) for name in SHARES}}


def signed_distance(mask):
    """Pixels to the mask's boundary, inside positive, in single precision; without a pixel outside it is infinite."""
    inside = distance_transform_edt(mask) if not mask.all() else np.full(mask.shape, np.inf)
    return np.where(mask, inside - 0.5, 0.5 - distance_transform_edt(~mask)).astype(np.float32)


def widened(mask, margin):
    """The pixels of the mask's box, so many wider on each side."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    result = np.zeros_like(mask)
    result[max(0, rows[0] - margin):rows[-1] + margin + 1, max(0, columns[0] - margin):columns[-1] + margin + 1] = True
    return result


class Network:
    """What is drawn of one frame."""

    def __init__(self, keys, seed, frame):
        self.dose, self.seed, self.frame = dose_of(keys), seed, frame

    def stream(self, purpose, *indices):
        return Stream(self.seed, f"labels.{purpose}", self.frame, *indices)

    def misses(self, instance, area):
        chance = self.dose["miss"] * self.dose["miss_area_px"] / (self.dose["miss_area_px"] + area)
        return self.stream("miss", instance).uniform() < chance

    def waves(self, shape, instance):
        """Standard normals at every pixel, smooth over the pitch."""
        (j, down), (i, right) = (lattice(size, self.dose["ragged_length_px"]) for size in shape)
        nodes = np.array([self.stream("ragged", instance, row).normals(i[-1] + 2) for row in range(j[-1] + 2)])
        total, squares = 0, 0
        for dj, di in ((0, 0), (0, 1), (1, 0), (1, 1)):
            weight = (down if dj else 1 - down)[:, None] * (right if di else 1 - right)[None, :]
            total = total + weight * nodes[np.ix_(j + dj, i + di)]
            squares = squares + weight**2
        return total / np.sqrt(squares)

    def discs(self, effect, shape, instance):
        """Pixels that lie in a disc; discs are centred on all pixels of the plane."""
        radius, (height, width) = self.dose["disc_radius_px"], shape
        reach = int(radius)
        disc = [(du, dv) for dv in range(-reach, reach + 1) for du in range(-reach, reach + 1)
                if du * du + dv * dv <= radius * radius]
        chance = 1 - (1 - self.dose[effect])**(1 / len(disc))
        centres = np.array([self.stream(effect, instance, MIDDLE + v).skip(MIDDLE - reach).uniforms(width + 2 * reach)
                            < chance for v in range(-reach, height + reach)])
        result = np.zeros(shape, bool)
        for du, dv in disc:
            result |= centres[reach + dv:reach + dv + height, reach + du:reach + du + width]
        return result

    def owners(self, masks, owned):
        """Of each pixel the instance whose moved boundary takes it, or 0; owned: the pixels that some mask truly has."""
        best, owner = np.full(owned.shape, -np.inf), np.zeros(owned.shape, np.int64)
        margin = math.ceil(max(0, self.dose["boundary_px"]) + 4 * self.dose["ragged_px"]) + 2
        for instance, mask in masks.items():
            rank = signed_distance(mask).astype(float) + self.dose["boundary_px"]
            if self.dose["ragged_px"] > 0:
                rank += self.dose["ragged_px"] * self.waves(owned.shape, instance)
            takes = (rank >= 0) & (mask | ~owned) & widened(mask, margin) & (rank > best)
            best[takes], owner[takes] = rank[takes], instance
        return owner

    def islands(self, mask, instance):
        away, reach = -signed_distance(mask), self.dose["island_reach_px"]
        return (away >= reach / 4) & (away <= reach) & self.discs("islands", mask.shape, instance)


def lattice(size, pitch):
    """Of each of so many pixels in a row the node before it, and how far beyond that it lies."""
    at = np.arange(size) / pitch
    return np.floor(at).astype(int), at - np.floor(at)


def noisy_masks(labels, detected, keys, seed, frame):
    """The label image with wrong masks; detected: the ids of instances of detected classes."""
    network = Network(keys, seed, frame)
    masks = {n: labels == n for n in np.unique(labels).tolist() if n in detected}
    result = np.where(np.isin(labels, list(masks)), 0, labels)
    masks = {n: mask for n, mask in masks.items() if not network.misses(n, mask.sum())}
    owned = np.isin(labels, list(masks))
    owner = network.owners(masks, owned)
    result[owner > 0] = owner[owner > 0]
    if network.dose["holes"] > 0:
        for instance in masks:
            result[(owner == instance) & network.discs("holes", labels.shape, instance)] = 0
    if network.dose["islands"] > 0:
        for instance, mask in masks.items():
            result[network.islands(mask, instance) & ~owned & ~np.isin(result, list(masks))] = instance
    return result


def chances_of(label, detected, dose):
    """Chance of each wrong class, by ascending id."""
    others = [other for other in detected if other != label]
    if dose["confusion_matrix"]:
        row = dose["confusion_matrix"][detected.index(label)]
        return {other: dose["scale"] * row[detected.index(other)] for other in others}
    return {other: dose["confusion"] / len(others) for other in others}


def blind_chance(m, right, is_right):
    if m < right and is_right:
        return (right - m) / (right * (1 - m))
    return (m - right) / (m * (1 - right)) if m > right and not is_right else 0


def verdict(label, detected, keys, seed, frame, instance):
    """Class and score of a detection; detected: ascending ids of the detected classes."""
    network = Network(keys, seed, frame)
    dose, chances = network.dose, chances_of(label, detected, network.dose)
    wrong, said = sum(chances.values()), label
    first, second = network.stream("class", instance).uniforms(2)
    if first < wrong:
        possible = [(other, chance) for other, chance in chances.items() if chance > 0]
        sums = np.cumsum([chance for _, chance in possible])
        said = possible[min(int((sums <= second * wrong).sum()), len(possible) - 1)][0]
    m = 1 - wrong if dose["score_mean"] is None else dose["score_mean"]
    a, b = dose["score_concentration"] * m, dose["score_concentration"] * (1 - m)
    if network.stream("blind", instance).uniform() >= blind_chance(m, 1 - wrong, said == label):
        a, b = (a + 1, b) if said == label else (a, b + 1)
    return said, 1 - dose["scores"] * (1 - network.stream("score", instance).beta(a, b))
