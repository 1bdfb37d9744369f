#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds `edge_aligned` against what the steps of docs/segmentation.md imply on boxes before a wall, pixel by pixel.

edge_aligned.py PROGRAM    writes recordings with wrong masks, calibrations and depths, has PROGRAM segment each, and
    compares which depth pixels it keeps for each object with those that truly show it. Depths that it settles are compared
    with planes fitted here, within 1e-6/m
"""

import os
import shutil
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import numpy as np
from PIL import Image
from scipy.ndimage import binary_dilation, binary_erosion, uniform_filter

sys.dont_write_bytecode = True

from crate_recording import WALL, Scene, write_recording
from drives import program
from point_files import read_pcd
from recording import Recording
from segmentation import register

SIZE, FOCAL, BASELINE = (120, 160), 140.0, 0.025
REACH_PX = 3  # default of reach_px
CRATE = (1, (2.0, 2.2), (-0.31, 0.27), (0.73, 1.31))


def scene_of(*boxes, baseline=BASELINE):
    return Scene((*boxes, WALL), SIZE, FOCAL, baseline)


def shifted(labels, right, down):
    """The image moved by whole pixels, its border continued."""
    rows, columns = (np.clip(np.arange(size) - by, 0, size - 1) for size, by in zip(SIZE, (down, right)))
    return labels[np.ix_(rows, columns)]


def disc(radius):
    v, u = np.indices((2 * radius + 1,) * 2) - radius
    return u * u + v * v <= radius * radius


def noisy(depth, random, amplitude):
    """1/z moved evenly by up to so much, and stored."""
    return np.rint(5000 / (1 / depth + amplitude * random.uniform(-1, 1, SIZE))) / 5000


class Kept:
    """What `mapscore segment` keeps of frame 0: .z is instance -> planar z of each depth pixel, 0 where it keeps none."""

    def __init__(self, mapscore, folder, *flags):
        out = folder + ".kept"
        shutil.rmtree(out, ignore_errors=True)
        program(mapscore, "segment", folder, "--method", "edge_aligned", "-o", out, *flags)
        self.z = {}
        for name in sorted(os.listdir(out)):
            if name.endswith(".pcd") and "voxels" not in name:
                points = read_pcd(os.path.join(out, name))
                x, y, z = (points[axis].astype(float) for axis in "xyz")
                image = self.z.setdefault(int(points["instance"][0]), np.zeros(SIZE))
                u, v = (FOCAL * at / z + (count - 1) / 2 for at, count in ((x, SIZE[1]), (y, SIZE[0])))
                image[np.rint(v).astype(int), np.rint(u).astype(int)] = z
                if np.abs([u - np.rint(u), v - np.rint(v)]).max() > 1e-3:
                    raise ValueError(f"{out}/{name}: a point lies on no pixel's ray")

    def mask(self, instance):
        return self.z.get(instance, np.zeros(SIZE)) > 0


class Bench:
    def __init__(self, mapscore, folder):
        self.mapscore, self.folder = mapscore, folder

    def kept(self, scene, *flags, **images):
        path = os.path.join(self.folder, "recording")
        shutil.rmtree(path, ignore_errors=True)
        write_recording(path, 1, scene, **images)
        return Kept(self.mapscore, path, *flags)


def wrong_pixels(kept, instance, instances=(1,)):
    """How many depth pixels were compared, and how many are kept that do not show the object, or lost that do."""
    return len(instances) * instance.size, sum(int((kept.mask(n) != (instance == n)).sum()) for n in instances)


def right_masks(bench):
    """A step all around: every pixel of the object and no other, from a pole of one pixel on."""
    for width in (0.017, 0.05):
        scene = scene_of((1, (2.0, 2.02), (0.1, 0.1 + width), (0.3, 1.7)))
        yield wrong_pixels(bench.kept(scene), scene.images()[1])
    scene = scene_of(CRATE)
    yield wrong_pixels(bench.kept(scene), scene.images()[1])


def moved_masks(bench):
    """Turns within search_px."""
    scene = scene_of(CRATE)
    _, instance, labels = scene.images()
    for right, down in ((3, 0), (-6, 4), (11, -7), (0, -25), (38, 0)):
        yield wrong_pixels(bench.kept(scene, labels=shifted(labels, right, down)), instance)


def wrong_calibrations(bench):
    """Shifts within 60 mm, turns within search_px; boards at two depths, so that one cannot be taken for the other."""
    scene = scene_of((1, (0.7, 0.7001), (0.03, 0.23), (0.93, 1.11)), (2, (2.3, 2.3001), (-0.7, -0.1), (0.6, 1.1)))
    turn = np.sin(np.radians(0.9)), np.cos(np.radians(0.9))
    for error in ((0.031, 0, 0, 0, 0, 0, 1), (0, -0.047, 0, 0, 0, 0, 1), (-0.02, 0.03, 0, 0, 0, 0, 1),
                  (0, 0, 0, 0, turn[0], 0, turn[1]), (0, 0, 0, turn[0], 0, 0, turn[1])):
        calibration = (error[0] - BASELINE, *error[1:])
        yield wrong_pixels(bench.kept(scene, T_color_depth=calibration), scene.images()[1], (1, 2))


def grown_and_shrunk_masks(bench):
    """The offset k of all outlines."""
    scene = scene_of(CRATE)
    _, instance, labels = scene.images()
    for k in (1, 2, 3, 4):
        for change in (binary_dilation, binary_erosion):
            yield wrong_pixels(bench.kept(scene, labels=change(labels == 1, disc(k))), instance)


def border_of_the_image(bench):
    """An object that goes on beyond the image is kept up to its border, since that is no outline."""
    scene = scene_of((1, (2.0, 2.2), (-0.3, 5), (-3, 1.2)))
    _, instance, labels = scene.images()
    for right, down in ((0, 0), (5, 3)):
        yield wrong_pixels(bench.kept(scene, labels=shifted(labels, right, down)), instance)


def slits(bench):
    """Masks grown over the slits of a crate give them back."""
    for gap in (0.06, 0.08):
        boards = [(1, (2.0, 2.02), (n * (0.2 + gap) - 0.5, n * (0.2 + gap) - 0.3), (0.7, 1.3)) for n in range(3)]
        scene = scene_of(*boards)
        _, instance, labels = scene.images()
        yield wrong_pixels(bench.kept(scene, labels=binary_dilation(labels == 1, disc(3))), instance)


def hidden_pixels(bench):
    """What the colour camera does not see gets no label of what hides it, and its own within reach_px alone."""
    scene = scene_of((1, (1.0, 1.1), (-0.15, 0.05), (0.8, 1.2)), (2, (2.0, 2.1), (-0.5, 0.5), (0.7, 1.3)),
                     baseline=0.2)
    depth, instance, labels = scene.images()
    path = os.path.join(bench.folder, "recording")
    kept = bench.kept(scene)
    recording = Recording(path)
    shown = register(recording, recording.cloud(depth), recording.T_color_depth)
    visible = np.zeros(instance.size, bool)
    visible[shown[shown >= 0]] = True
    visible = visible.reshape(SIZE)
    sure = binary_erosion(visible, np.ones((3, 3))) | ~binary_dilation(visible, disc(REACH_PX))
    expected = np.where(visible, instance, 0)
    yield sure.sum(), sum(int((sure & (kept.mask(n) != (expected == n))).sum()) for n in (1, 2))
    yield (~visible).sum(), int((kept.mask(1) & ~visible).sum())


def contacts(bench):
    """Two flush fronts: neither takes a pixel of the other, and none is left out where they meet."""
    scene = scene_of((1, (2.0, 2.2), (-0.3, 0), (0.7, 1.3)), (2, (2.0, 2.2), (0, 0.3), (0.7, 1.3)))
    for reach in (1, 3, 6):
        yield wrong_pixels(bench.kept(scene, "--reach_px", str(reach)), scene.images()[1], (1, 2))


def square(u, v, half):
    result = np.zeros(SIZE, bool)
    result[v - half:v + half + 1, u - half:u + half + 1] = True
    return result


def nothing_to_fit(bench):
    """A mask on a bare wall stays where it is, less a rim of reach_px, also beside edges that are few."""
    parallax = FOCAL * BASELINE / 3
    nail = 0, (2.8, 2.8001), (-0.66, -0.57), (0.96, 1.04)
    for reach, half, scene in ((1, 3, scene_of()), (1, 4, scene_of()), (1, 9, scene_of()), (REACH_PX, 12, scene_of()),
                               (REACH_PX, 20, scene_of()), (REACH_PX, 20, scene_of(nail))):
        kept = bench.kept(scene, "--reach_px", str(reach), labels=square(80, 60, half)).mask(1)
        least, most = (square(round(80 + parallax), 60, half - reach + more) for more in (-3, 1))
        yield kept.size, int((kept & ~most).sum() + (least & ~kept).sum())


def save_image(image, kind, *path):
    Image.fromarray(image.astype(kind)).save(os.path.join(*path))


def other_inputs(bench):
    """The same points with other colours, classes and frames, and without truth."""
    scene = scene_of(CRATE, (2, (1.2, 1.2001), (0.4, 0.6), (0.9, 1.21)))
    random = np.random.default_rng(1)
    depth, _, labels = scene.images()
    images = {"depth": noisy(depth, random, 0.003), "labels": shifted(labels, 4, 2)}
    before = bench.kept(scene, **images)
    path = os.path.join(bench.folder, "changed")
    write_recording(path, 2, scene, **images)
    save_image(random.integers(0, 256, (*SIZE, 3)), np.uint8, path, "color", "000000.png")
    save_image(random.integers(0, 3, SIZE), np.uint16, path, "depth_label", "000000.png")
    save_image(random.integers(3000, 9000, SIZE), np.uint16, path, "depth", "000001.png")
    save_image(random.integers(0, 3, SIZE), np.uint16, path, "label", "000001.png")
    shutil.rmtree(os.path.join(path, "truth"))
    head = os.path.join(path, "recording.yaml")
    with open(head, encoding="utf-8") as text:
        changed = text.read().replace("has_truth: true", "has_truth: false").replace("crate_2, class: 1", "lamp, class: 2")
    with open(head, "w", encoding="utf-8") as text:
        text.write(changed.replace("instances:", '  - {id: 2, name: lamp, colour: "00FF00", detect: true}\ninstances:'))
    after = Kept(bench.mapscore, path)
    yield 2 * labels.size, sum(int((after.z[n] != before.z[n]).sum()) for n in (1, 2))


def measured_points(bench):
    """In depth as good as exact every kept point is the measured one."""
    random = np.random.default_rng(2)
    scene = scene_of(CRATE)
    depth = noisy(scene.images()[0], random, 0.0003)
    z = bench.kept(scene, depth=depth).z[1]
    yield z.size, int(((z > 0) & (np.abs(z - depth) > 1e-6)).sum())


def settled_depth(bench):
    """In noisy depth each kept point inside an object lies on the plane in 1/z of the 9 x 9 pixels about it, fitted to what such
    planes gave before."""
    random = np.random.default_rng(3)
    scene = scene_of(CRATE)
    depth, instance, _ = scene.images()
    for amplitude in (0.0015, 0.003, 0.006):
        z = noisy(depth, random, amplitude)
        kept = bench.kept(scene, depth=z)
        inner = binary_erosion(instance == 1, np.ones((17, 17)))
        # by symmetry a plane's value in the middle is the mean
        planes = uniform_filter(uniform_filter(1 / z, 9), 9)
        yield int(inner.sum()), int((np.abs(planes - 1 / np.maximum(kept.z[1], 1e-9))[inner] > 1e-6).sum())


def uncertain_depth(bench):
    """Far and noisy, a small object's corners are left out, whose planes few pixels tell, and its middle is kept."""
    random = np.random.default_rng(5)
    scene = Scene(((1, (4.0, 4.2), (-0.6, 0.6), (0.4, 1.6)), (0, (6.0, 6.2), (-9, 9), (-9, 9))), SIZE, FOCAL, BASELINE)
    depth, instance, _ = scene.images()
    amplitude = 0.0035  # 1 / (9 sqrt 3) of it are 4 mm at 4 m, sqrt(7 / 25) of its standard deviation 17 mm
    kept = bench.kept(scene, depth=noisy(depth, random, amplitude)).z[1] > 0
    inner = binary_erosion(instance == 1, np.ones((9, 9)))
    yield int(inner.sum()), int((inner & ~kept).sum())
    rows, columns = (np.flatnonzero((instance == 1).any(axis=axis)) for axis in (1, 0))
    corners = np.ix_(rows[[0, -1]], columns[[0, -1]])
    yield 4, int((kept & (instance == 1))[corners].sum())


def flying_pixels(bench):
    """In noisy depth pixels that fly off an object are left out, and no others inside it."""
    random = np.random.default_rng(4)
    scene = scene_of(CRATE)
    depth, instance, _ = scene.images()
    z = noisy(depth, random, 0.003)
    flying = (instance == 1) & (random.uniform(size=SIZE) < 0.05)
    z[flying] = np.rint(5000 * random.uniform(2.1, 2.4, flying.sum())) / 5000
    yield wrong_pixels(bench.kept(scene, depth=z), np.where(flying, 0, instance))


CHECKS = {
    "right masks keep every pixel of an object and no other": right_masks,
    "moved masks are moved back": moved_masks,
    "wrong calibrations are corrected at every depth": wrong_calibrations,
    "grown and shrunk masks are fitted": grown_and_shrunk_masks,
    "the image's border is no outline": border_of_the_image,
    "slits that masks cover are given back": slits,
    "hidden pixels get no label of what hides them": hidden_pixels,
    "contacts of two objects leave nothing out": contacts,
    "without steps nothing is corrected": nothing_to_fit,
    "colours, classes, truth and other frames change nothing": other_inputs,
    "exact depth stays as it was measured": measured_points,
    "noisy depth settles on planes of 9 x 9 pixels, twice": settled_depth,
    "uncertain depth is dropped": uncertain_depth,
    "flying pixels are dropped": flying_pixels}


def main(mapscore):
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for name, check in CHECKS.items():
            compared, differ = (sum(column) for column in zip(*check(Bench(os.path.abspath(mapscore), folder))))
            print(f"{name}: {compared} pixels compared, {differ} differ", flush=True)
            failed |= differ > 0 or compared == 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
