# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A depth image as a structured-light camera would have measured it, by docs/methods.md."""

import numpy as np

from streams import Stream

UNITS = 5000.0  # of a stored depth image in a metre
DOSES = ("shadow", "grazing", "flying", "lateral", "axial", "quantisation", "range")
DEFAULTS = {**dict.fromkeys(DOSES, 0), "scale": 1, "axial_base_m": 0.0012, "axial_growth_per_m": 0.0019,
            "lateral_px": 0.8, "baseline_m": 0.075, "subpixel_px": 0.125, "grazing_from_deg": 70, "grazing_to_deg": 85,
            "flying_share": 0.1, "range_min_m": 0.6, "range_max_m": 8}
PRESETS = {"ideal": {}, "astra": dict.fromkeys(DOSES, 1),
           "kinect_v1": {**dict.fromkeys(DOSES, 1), "range_min_m": 0.8, "range_max_m": 4}}


def dose_of(keys):
    """All keys of faults.depth, from those that a study gives."""
    dose = {**DEFAULTS, **PRESETS[keys.get("preset", "ideal")], **keys}
    return {**dose, **{name: dose["scale"] * dose[name] for name in DOSES}}


def step_limit(camera):
    return np.tan(np.radians(87)) / ((camera["fx_px"] + camera["fy_px"]) / 2)


def is_step(one, other, limit):
    return np.abs(one - other) > limit * np.minimum(one, other)


def neighbour(image, along, across):
    """The value so many columns to the right and rows down of each pixel; 0 beyond the image."""
    height, width = image.shape
    padded = np.zeros((height + 4, width + 4))
    padded[2:-2, 2:-2] = image
    return padded[2 + across:2 + across + height, 2 + along:2 + along + width]


def slopes(w, limit, right, down):
    """Slope of 1/z a pixel towards one axis: over both sides, the flatter of two that differ much, one, or 0."""
    reach, ends = [], []
    for sign in (-1, 1):
        far, near = (neighbour(w, n * sign * right, n * sign * down) for n in (2, 1))
        takes_far = (far > 0) & ~is_step(w, far, 2 * limit)
        takes_near = ~takes_far & (near > 0) & ~is_step(w, near, limit)
        reach.append(np.select([takes_far, takes_near], [2 * sign, sign], 0))
        ends.append(np.select([takes_far, takes_near], [far, near], w))
    sides = [np.divide(end - w, n, out=np.zeros_like(w), where=n != 0) for end, n in zip(ends, reach)]
    whole = np.divide(ends[1] - ends[0], reach[1] - reach[0], out=np.zeros_like(w), where=reach[1] != reach[0])
    sizes = np.abs(sides)
    flatter = np.where(sizes[0] < sizes[1], sides[0], sides[1])
    differ = np.abs(sides[0] - sides[1]) > sizes.max(axis=0) / 2
    return np.where((reach[0] != 0) & (reach[1] != 0) & differ, flatter, whole)


def incidence(z, camera):
    """Angle between ray and normal, in single precision, 0 without a depth."""
    w, limit = np.divide(1, z, out=np.zeros_like(z), where=z > 0), step_limit(camera)
    v, u = np.indices(z.shape)
    x, y = (u - camera["cx_px"]) / camera["fx_px"], (v - camera["cy_px"]) / camera["fy_px"]
    a, b = camera["fx_px"] * slopes(w, limit, 1, 0), camera["fy_px"] * slopes(w, limit, 0, 1)
    c = w - a * x - b * y
    length = np.sqrt((a * a + b * b + c * c) * (x * x + y * y + 1))
    cosine = np.divide(w, length, out=np.ones_like(w), where=z > 0)
    return np.arccos(np.minimum(1, cosine)).astype(np.float32).astype(float)


def steepness(theta):
    theta = np.minimum(theta, np.radians(85))
    return theta / (np.pi / 2 - theta)


def in_shadow(z, camera, baseline):
    """Where another pixel of the row stands nearer on the projector's ray."""
    result, limit = np.zeros(z.shape, bool), step_limit(camera)
    for row, shadow in zip(z, result):
        seen = np.flatnonzero(row > 0)
        if len(seen) == 0:
            continue
        eighth = np.floor(8 * (seen - camera["fx_px"] * baseline / row[seen])).astype(int)
        first = eighth.min() - 4
        nearest = np.full(eighth.max() + 4 - first, np.inf)
        for part in range(-4, 4):
            np.minimum.at(nearest, eighth + part - first, row[seen])
        caster = nearest[eighth - first]
        shadow[seen] = row[seen] - caster > limit * caster
    return result


def across_step(z, camera):
    """Depth across the largest step among the four neighbours, 0 where there is none."""
    across, largest = np.zeros(z.shape), np.zeros(z.shape)
    for right, down in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        there = neighbour(z, right, down)
        both = (z > 0) & (there > 0)
        size = np.where(both, np.abs(1 / np.where(both, z, 1) - 1 / np.where(both, there, 1)), 0)
        wins = both & is_step(z, there, step_limit(camera)) & (size > largest)
        across[wins], largest[wins] = there[wins], size[wins]
    return across


def without_grazing(z, theta, dose, stream):
    first, last = np.radians([dose["grazing_from_deg"], dose["grazing_to_deg"]])
    chance = dose["grazing"] * np.clip((theta - first) / (last - first), 0, 1)
    return np.where(stream.uniforms(z.size).reshape(z.shape) < chance, 0, z)


def with_flying(z, other, dose, stream):
    chance, m = np.moveaxis(stream.uniforms(2 * z.size).reshape(*z.shape, 2), 2, 0)
    flies = (z > 0) & (other > 0) & (chance < dose["flying"] * dose["flying_share"])
    return np.where(flies, z + m * (other - z), z)


def displaced(z, theta, dose, stream):
    """Depth and angle that each pixel reports."""
    sigma = dose["lateral"] * (dose["lateral_px"] + 0.035 * steepness(theta))
    away = np.rint(sigma[..., None] * stream.normals(2 * z.size).reshape(*z.shape, 2)).astype(int)
    (v, u), (height, width) = np.indices(z.shape), z.shape
    v, u = np.clip(v + away[..., 1], 0, height - 1), np.clip(u + away[..., 0], 0, width - 1)
    return z[v, u], theta[v, u]


def with_axial_noise(z, theta, dose, stream):
    angular = 0.0001 / np.sqrt(np.where(z > 0, z, 1)) * steepness(theta)**2
    sigma = dose["axial"] * (dose["axial_base_m"] + dose["axial_growth_per_m"] * (z - 0.4)**2 + angular)
    return np.where(z > 0, np.maximum(0, z + sigma * stream.normals(z.size).reshape(z.shape)), 0)


def quantised(z, disparity, step):
    """disparity: that of 1 m."""
    steps = np.rint(np.divide(disparity, z * step, out=np.zeros(z.shape), where=z > 0))
    return np.divide(disparity, steps * step, out=np.zeros(z.shape), where=steps > 0)


def without_far(stored, dose, stream):
    z = stored / UNITS
    outside = (z < dose["range_min_m"]) | (z > dose["range_max_m"])
    return np.where(outside & (stream.uniforms(z.size).reshape(z.shape) < dose["range"]), 0, stored)


def measured(stored, camera, keys, seed, index):
    """The stored values of a depth image under faults.depth; index: the image's number."""
    dose, exact = dose_of(keys), stored / UNITS
    theta, z = incidence(exact, camera), exact
    def stream(effect):
        return Stream(seed, f"depth.{effect}", index)
    if dose["shadow"] > 0:
        z = np.where(in_shadow(exact, camera, dose["shadow"] * dose["baseline_m"]), 0, z)
    if dose["grazing"] > 0:
        z = without_grazing(z, theta, dose, stream("grazing"))
    if dose["flying"] > 0:
        z = with_flying(z, across_step(exact, camera), dose, stream("flying"))
    if dose["lateral"] > 0:
        z, theta = displaced(z, theta, dose, stream("lateral"))
    if dose["axial"] > 0:
        z = with_axial_noise(z, theta, dose, stream("axial"))
    if dose["quantisation"] > 0:
        z = quantised(z, camera["fx_px"] * dose["baseline_m"], dose["quantisation"] * dose["subpixel_px"])
    result = np.rint(z * UNITS).astype(np.int64)
    return without_far(result, dose, stream("range")) if dose["range"] > 0 else result
