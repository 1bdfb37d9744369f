#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Checks the independent ruler on small inputs whose answers are known by hand, or by a slow optimiser."""

import os
import sys
import tempfile
import warnings
from types import SimpleNamespace

import numpy as np
from scipy.optimize import minimize

sys.dont_write_bytecode = True
warnings.filterwarnings("ignore", message="Values in x were outside bounds")  # SLSQP talks

from convex import corners_of
from crate_recording import HERE, check_recording, write_recording
from distances import cube_distances
from recording import map_from_world, moved
from segmentation import eroded, exponential, grow_region, register
from streams import Stream
from surfaces import KINDS, Box, Cylinder, Ellipsoid, Plane, Sphere
from truth import Samples, cubes_of, pack, surface_truth, unpack, visible_truth, voxels_of


def expect(what, got, wanted, tolerance=0.0):
    if not np.allclose(got, wanted, rtol=0, atol=tolerance):
        sys.exit(f"selfcheck: {what}: got {got}, expected {wanted}")
    print(f"ok  {what}")


# ---- shapes against a general optimiser -------------------------------------------------------------------------

def inside_value(kind, size, p):
    """<= 0 exactly in the closed solid; smooth pieces, written apart from surfaces.py."""
    x, y, z = p
    if kind in ("box", "plane"):
        return np.array([abs(v) - s for v, s in zip(p, (size[0], size[1], 0 if kind == "plane" else size[2]))])
    if kind == "sphere":
        return np.array([x * x + y * y + z * z - size[0]**2])
    if kind == "ellipsoid":
        return np.array([(x / size[0])**2 + (y / size[1])**2 + (z / size[2])**2 - 1])
    if kind == "cylinder":
        return np.array([x * x + y * y - size[0]**2, abs(z) - size[1]])
    beyond = max(0, abs(z) - size[1])
    return np.array([x * x + y * y + beyond * beyond - size[0]**2])


def slow_distance(kind, size, rotation, centre, low, high):
    """Cube to solid by SLSQP over both points."""
    best = np.inf
    for start in ((low + high) / 2, low, high):
        solution = minimize(
            lambda q: ((q[:3] - (rotation @ q[3:] + centre))**2).sum(), np.concatenate([start, np.zeros(3)]),
            bounds=[*zip(low, high)] + ([(-s, s) for s in (size[0], size[1], 0)] if kind == "plane" else
                                        [(-s, s) for s in size] if kind == "box" else [(None, None)] * 3),
            constraints=[] if kind in ("box", "plane") else
            [{"type": "ineq", "fun": lambda q: -inside_value(kind, size, q[3:])}],
            method="SLSQP", options={"maxiter": 300, "ftol": 1e-15})
        if inside_value(kind, size, solution.x[3:]).max() < 1e-7:
            best = min(best, np.sqrt(max(0, solution.fun)))
    return best


def check_shapes():
    random = np.random.default_rng(1)
    for kind, make in KINDS.items():
        worst = wrong = 0
        for _ in range(20):
            size, centre = random.uniform(0.05, 0.4, 3), random.uniform(-0.2, 0.2, 3)
            rotation = exponential(random.normal(size=3)) if random.uniform() < 0.8 else np.eye(3)
            shape = make(rotation, centre, size)
            low = random.uniform(-0.8, 0.8, (3, 3))
            high = low + random.uniform(0.02, 0.3)
            quick = np.where(shape.contains(low, high) | shape.meets(low, high), 0, shape.outer_distance(low, high))
            slow = np.array([slow_distance(kind, size, rotation, centre, *cube) for cube in zip(low, high)])
            worst = max(worst, np.abs(quick - slow).max())
            # inner side: a small cube in the solid; its depth is the least of support - n.p over directions n
            if shape.solid:
                near = centre + random.uniform(-0.01, 0.01, 3)
                cube = (near - 0.01)[None], (near + 0.01)[None]
                if shape.contains(*cube)[0]:
                    normals = random.normal(size=(4000, 3))
                    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
                    normals = np.vstack([normals, rotation.T, -rotation.T])
                    reach = np.array([np.dot(shape.support(n), n) for n in normals])
                    slow = (reach[:, None] - normals @ corners_of(*cube)[0].T).min()
                    gap = slow - shape.boundary_distance(*cube)[0]
                    wrong += not -1e-9 <= gap < 0.01
            # the boundary test against points on the boundary
            samples = shape.world(boundary_samples(kind, size, random))
            hit = ((samples[:, None] >= low) & (samples[:, None] <= high)).all(-1).any(0)
            wrong += (hit & ~shape.boundary_meets(low, high)).sum()
        expect(f"{kind}: distance to cubes agrees with SLSQP", worst, 0, 2e-5)
        expect(f"{kind}: inner depth and boundary samples", wrong, 0)


def boundary_samples(kind, size, random):
    n = random.normal(size=(3000, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    flat = n[:, :2] / np.linalg.norm(n[:, :2], axis=1, keepdims=True)
    along = random.uniform(-size[1], size[1], (3000, 1))
    if kind == "sphere":
        return n * size[0] * (1 - 1e-12)
    if kind == "ellipsoid":
        return n * size * (1 - 1e-12)
    if kind in ("cylinder", "capsule"):
        return np.hstack([flat * size[0] * (1 - 1e-12), along])
    q = random.uniform(-1, 1, (3000, 3)) * size
    q[:, 2] = size[2] if kind == "box" else 0
    return q


# ---- truth --------------------------------------------------------------------------------------------------------

def check_truth():
    one = np.eye(3)
    box = Box(one, np.array([2.13, 0, 1]), (0.1, 0.3, 0.3))
    rows = surface_truth([(1, box)], 0.1, 0.0005)[1]
    expect("box with faces on the lattice: voxels, touch only", (len(rows), sum(rows.values())), (176, 104))
    generic = Box(one, np.array([0.55, 0.55, 0.55]), (0.22, 0.22, 0.22))  # [0.33, 0.77]: 3..7, hollow 4..6
    rows = surface_truth([(1, generic)], 0.1, 0)[1]
    expect("box off the lattice", (len(rows), sum(rows.values())), (5**3 - 3**3, 0))
    plane = Plane(one, np.array([0.05, 0.05, 0.1]), (0.16, 0.02, 0))  # on a lattice plane: both layers touch
    rows = surface_truth([(2, plane)], 0.1, 0)[2]
    expect("plane on the lattice", (len(rows), sum(rows.values())), (10, 10))  # x -0.11..0.21: 5 columns

    floor = Box(one, np.array([0, 0, -0.02]), (1, 1, 0.05))  # top at z = 0.03
    def standing_on(z, half=0.25):
        thing = Box(one, np.array([0.05, 0.05, z + half]), (half, half, half))  # x, y from -0.2 to 0.3
        return surface_truth([(0, floor), (1, thing)], 0.1, 0.0005)[1]
    def low_core(rows):  # voxels under the middle of the thing, at or below its bottom face
        return sum(1 for key in rows if (np.abs(unpack(np.int64(key))[:2]) <= 1).all() and unpack(np.int64(key))[2] <= 1)
    expect("contact faces stay", low_core(standing_on(0.03)), 9)
    expect("a sunken bottom is buried", low_core(standing_on(-0.01)), 0)  # in [-0.07, 0.03], 4 cm deep
    inner = Sphere(one, np.array([0.1, 0.1, 0.0]), (0.01,))
    expect("a body inside another has no surface", len(surface_truth([(0, floor), (1, inner)], 0.1, 0).get(1, {})), 0)
    half = Sphere(one, np.array([0.05, 0.05, 0.03]), (0.045,))  # z -0.015..0.075: voxel -1 is buried, 0 not
    expect("a half sunken sphere stays", len(surface_truth([(0, floor), (1, half)], 0.1, 0)[1]), 1)
    glass = Plane(one, np.array([0.05, 0.05, 0.05]), (0.04, 0.04, 0))
    cover = Box(one, np.array([0.05, 0.05, 0.05]), (0.3, 0.3, 0.3))
    expect("a plane inside a box is buried", len(surface_truth([(0, cover), (1, glass)], 0.1, 0).get(1, {})), 0)
    expect("a plane buries nothing", len(surface_truth([(0, glass), (1, cover)], 0.1, 0)[0]), 0)

    samples = Samples()
    key = pack(np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]))
    samples.add(np.repeat(key, [4, 3, 2, 1]), np.array([1, 1, 2, 2, 0, 0, 2, 1, 0, 1]))
    surface = {1: dict.fromkeys(key.tolist(), False), 2: dict.fromkeys(key[:2].tolist(), False)}
    visible = visible_truth(samples, surface)
    expect("owner: tie to the lower id, background, ...", sorted(visible[1].items()), [(key[0], 4), (key[3], 1)])
    expect("... and 4 samples", (len(visible_truth(samples, surface, 4)[1]), len(visible[2])), (1, 0))
    expect("yaw 90 of the map", moved(map_from_world((1, 2, 3), np.pi / 2), np.array([1.0, 5, 3])), (3, 0, 0), 1e-12)


# ---- random streams -----------------------------------------------------------------------------------------------

def check_streams():
    """Against the table of docs/methods.md: seed, purpose, indices, first words, uniforms, normals."""
    with open(os.path.join(HERE, "..", "..", "docs", "methods.md"), encoding="utf-8") as page:
        rows = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in page if "| 0x" in line]
    expect("methods.md names four streams", len(rows), 4)
    for seed, purpose, indices, words, uniforms, normals in rows:
        name = int(seed), purpose.strip("`"), *(int(index) for index in indices.split(", ") if index != "none")
        told = [[float(value) for value in column.split(", ")] for column in (uniforms, normals)]
        stream = Stream(*name)
        expect(f"stream {name}: words", [hex(int(word)) for word in stream.words(3)] == words.split(", "), True)
        expect(f"stream {name}: uniforms", Stream(*name).uniforms(2), told[0], 1e-16)
        expect(f"stream {name}: normals", Stream(*name).normals(3), told[1], 1e-15)
        single = Stream(*name)
        expect(f"stream {name}: normals one by one", [single.normal() for _ in range(3)], told[1], 1e-15)


# ---- segmentation -------------------------------------------------------------------------------------------------

def check_segmentation():
    camera = dict(width_px=8, height_px=6, fx_px=10.0, fy_px=10.0, cx_px=3.5, cy_px=2.5)
    sharp = dict(camera, fx_px=20.0, width_px=16, cx_px=7.5)
    cloud = np.zeros((48, 3))
    cloud[2 * 8 + 3] = 2 * np.array([-0.05, -0.05, 1])  # depth pixel (3, 2)
    recording = SimpleNamespace(color=camera, depth=camera)
    shown = register(recording, cloud, np.eye(4))
    expect("identical cameras: one pixel", np.argwhere(shown >= 0), [[2, 3]])
    recording.color = sharp  # u = 20 * -0.05 + 7.5 = 6.5, s = 2, h = 1: columns 6 and 7
    expect("splat by the ratio of focal lengths", np.argwhere(register(recording, cloud, np.eye(4)) >= 0), [[2, 6], [2, 7]])
    closer = np.eye(4)
    closer[2, 3] = -1.0  # z_color = 1: u = 20 * -0.1 + 7.5 = 5.5, h = 2: 4..7; v = 10 * -0.1 + 2.5 = 1.5, h = 1: 1, 2
    expect("splat grows with z_depth / z_color", (register(recording, cloud, closer) >= 0).sum(), 8)
    cloud[0], cloud[1] = cloud[2 * 8 + 3] * 0.5, cloud[2 * 8 + 3]
    recording.color = camera
    shown = register(recording, cloud, np.eye(4))
    expect("nearest wins", shown[2, 3], 0)
    cloud[0] = cloud[1]
    expect("tie to the lower pixel", register(recording, cloud, np.eye(4))[2, 3], 0)

    mask = np.zeros((20, 20), bool)
    mask[5:16, 0:9] = True  # touches the left edge
    expect("erosion goes on beyond the image", np.argwhere(eroded(mask, 3)).min(0).tolist()
           + np.argwhere(eroded(mask, 3)).max(0).tolist(), [8, 0, 12, 5])
    mask[:] = True
    mask[10, 10] = False
    expect("erosion by a disc", (~eroded(mask, 2)).sum(), 13)

    line = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.16, 0, 0], [0.2, 0.049, 0], [0.5, 0, 0], [0.05, 0, 0]])
    places, kept = grow_region(line, line[0], 0.1, 0.05)
    expect("growing r/2: places", sorted(places[:, 0]), [0, 1, 2])
    expect("growing r/2: kept; on the sphere is out", kept, [1, 1, 1, 1, 0, 0])
    places, kept = grow_region(line, line[0], 0.1, 0.1)
    expect("growing r: kept", kept, [1, 1, 1, 1, 0, 1])
    expect("growing needs its first place", grow_region(line + [1, 0, 0], line[0], 0.1, 0.1)[1].any(), False)

    random = np.random.default_rng(2)
    points = random.uniform(-1, 2, (500, 3))
    keys = np.unique(voxels_of(random.uniform(0, 1, (200, 3)), 0.1))
    low, high = cubes_of(keys, 0.1)
    slow = np.linalg.norm(np.maximum(0, np.maximum(low - points[:, None], points[:, None] - high)), axis=-1).min(1)
    expect("distance to the nearest cube", cube_distances(points, keys, 0.1), slow, 1e-12)


if __name__ == "__main__":
    check_shapes()
    check_truth()
    check_streams()
    check_segmentation()
    with tempfile.TemporaryDirectory() as temporary:
        write_recording(os.path.join(temporary, "recording"))
        check_recording(os.path.join(temporary, "recording"), expect)
    print("selfcheck: all well")
