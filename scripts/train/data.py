# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Recordings as arrays of 320 x 240: colours, depth seen from the colour camera, classes.

Colours are averaged over 2 x 2 pixels; classes are those of the upper left one. Depth points are moved
into the colour camera, and the nearest one that meets a pixel stays, as a driver's "registered" depth.
"""

import pathlib

import cv2
import numpy as np
import yaml

HEIGHT, WIDTH = 240, 320
UNITS_PER_M = 5000


class Camera:
    """Pinhole camera of recording.yaml, for images of another size."""

    def __init__(self, camera, width=None):
        scale = (width or camera["width_px"]) / camera["width_px"]
        self.fx, self.fy = camera["fx_px"] * scale, camera["fy_px"] * scale
        self.cx, self.cy = ((camera[c] + 0.5) * scale - 0.5 for c in ("cx_px", "cy_px"))


def rotation(x, y, z, w):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def registered(depth, depth_camera, color_camera, T_color_depth):
    """Depth (1/5000 m) seen from the colour camera, HEIGHT x WIDTH; 0 where nothing falls."""
    v, u = np.nonzero(depth)
    z = depth[v, u] / UNITS_PER_M
    p_depth = np.stack([(u - depth_camera.cx) / depth_camera.fx * z, (v - depth_camera.cy) / depth_camera.fy * z, z])
    p_color = rotation(*T_color_depth[3:]) @ p_depth + np.array(T_color_depth[:3])[:, None]
    z = p_color[2]
    u = np.rint(p_color[0] / z * color_camera.fx + color_camera.cx).astype(int)
    v = np.rint(p_color[1] / z * color_camera.fy + color_camera.cy).astype(int)
    seen = (z > 0) & (u >= 0) & (u < WIDTH) & (v >= 0) & (v < HEIGHT)
    u, v, z = u[seen], v[seen], np.minimum(np.rint(z[seen] * UNITS_PER_M), 65535).astype(np.uint16)
    far_first = np.argsort(65535 - z, kind="stable")
    image = np.zeros((HEIGHT, WIDTH), np.uint16)
    image[v[far_first], u[far_first]] = z[far_first]
    return image


def listed(folder, name):
    return [line.split()[1] for line in (folder / name).read_text().splitlines()
            if line and not line.startswith("#")]


def read(folder, keep=True):
    """Arrays of a recording: color (N, H, W, 3), depth (N, H, W), label (N, H, W) and the names of its classes.

    Kept in the recording's folder as frames.npz, unless told not to.
    """
    folder = pathlib.Path(folder)
    kept = folder / "frames.npz"
    meta = yaml.safe_load((folder / "recording.yaml").read_text())
    names = [c["name"] for c in meta["classes"]]
    if kept.exists():
        with np.load(kept) as arrays:
            return arrays["color"], arrays["depth"], arrays["label"], names
    class_of = np.zeros(65536, np.uint8)
    for instance in meta["instances"]:
        class_of[instance["id"]] = instance["class"]
    depth_camera, color_camera = Camera(meta["depth"]), Camera(meta["color"], WIDTH)
    color, depth, label = [], [], []
    for c, d in zip(listed(folder, "color.txt"), listed(folder, "depth.txt")):
        picture = cv2.imread(str(folder / c), cv2.IMREAD_COLOR)
        color.append(cv2.resize(picture, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)[:, :, ::-1])
        measured = cv2.imread(str(folder / d), cv2.IMREAD_UNCHANGED)
        depth.append(registered(measured, depth_camera, color_camera, meta["T_color_depth"]))
        ids = cv2.imread(str(folder / "label" / pathlib.Path(c).name), cv2.IMREAD_UNCHANGED)
        label.append(class_of[cv2.resize(ids, (WIDTH, HEIGHT), interpolation=cv2.INTER_NEAREST)])
    arrays = {"color": np.stack(color), "depth": np.stack(depth), "label": np.stack(label)}
    if keep:
        np.savez(kept, **arrays)
    return arrays["color"], arrays["depth"], arrays["label"], names


def class_lists():
    return yaml.safe_load((pathlib.Path(__file__).parent / "classes.yaml").read_text())


def folded(label, names, fold):
    """Class ids of a recording as channels of a class list ({name: [scene's classes]}); others are 0."""
    channel = np.zeros(256, np.uint8)
    for n, scene_classes in enumerate(fold.values(), 1):
        for name in scene_classes:
            if name in names:
                channel[names.index(name)] = n
    return channel[label]


class Frames:
    """Frames of several recordings, folded onto one list of classes."""

    def __init__(self, folders, fold, dull=1.0):
        """`dull`: leaves out frames of which one class covers more than this share."""
        parts = []
        for folder in folders:
            color, depth, label, names = read(folder)
            label = folded(label, names, fold)
            share = np.array([np.bincount(l.ravel(), minlength=1).max() / l.size for l in label])
            keep = share <= dull
            parts.append((color[keep], depth[keep], label[keep]))
        self.color, self.depth, self.label = (np.concatenate(p) for p in zip(*parts))

    def __len__(self):
        return len(self.color)


def class_weights(label, classes, most=5.0):
    """Median-frequency weights ([X], equations 1 and 2), at most `most`; 0 for background and what is absent."""
    counts = np.stack([np.bincount(l.ravel(), minlength=classes) for l in label])
    with_class = (counts > 0).sum(0)
    frequency = counts.sum(0) / np.maximum(with_class * label[0].size, 1)
    frequency[0] = 0
    known = frequency > 0
    weights = np.zeros(classes, np.float32)
    weights[known] = np.minimum(np.median(frequency[known]) / frequency[known], most)
    return weights
