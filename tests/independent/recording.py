# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Reads a recording as docs/formats.md describes it."""

import csv
import os

import numpy as np
import yaml
from PIL import Image

from convex import rotation_of_quaternion
from surfaces import KINDS
from triangles import read_triangles


def transform(numbers):
    """4 x 4 matrix of tx ty tz qx qy qz qw."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation_of_quaternion(numbers[3:7])
    matrix[:3, 3] = numbers[:3]
    return matrix


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def map_from_world(origin, yaw):
    """p_map = Rz(yaw)^T (p_world - origin)."""
    c, s = np.cos(yaw), np.sin(yaw)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    matrix[:3, 3] = -matrix[:3, :3] @ np.asarray(origin, float)
    return matrix


def table_rows(path):
    with open(path, encoding="utf-8") as lines:
        return [line.split() for line in lines if line.strip() and not line.startswith("#")]


def nearest_index(stamps, stamp):
    return int(np.argmin(np.abs(np.asarray(stamps) - stamp)))


class Recording:
    def __init__(self, folder):
        self.folder = folder
        with open(self.path("recording.yaml"), encoding="utf-8") as text:
            head = yaml.safe_load(text)
        if head["format_version"] != 1:
            raise ValueError(f"{folder}: format version {head['format_version']}, not 1")
        self.color, self.depth = head["color"], head["depth"]
        self.T_color_depth, self.T_base_depth = transform(head["T_color_depth"]), transform(head["T_base_depth"])
        self.names = {entry["id"]: str(entry["name"]) for entry in head["classes"]}
        self.colours = {entry["id"]: tuple(bytes.fromhex(entry["colour"])) for entry in head["classes"]}
        self.detected = {entry["id"] for entry in head["classes"] if entry["detect"]}
        self.class_of = np.full(max(entry["id"] for entry in head["instances"]) + 1, -1)
        for entry in head["instances"]:
            self.class_of[entry["id"]] = entry["class"]
        self.frames = self.pair_streams()

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def pair_streams(self):
        """One frame a colour image: (label file, depth file, depth label file, T_world_base) at the nearest depth stamp."""
        color, depth = table_rows(self.path("color.txt")), table_rows(self.path("depth.txt"))
        poses = [[float(word) for word in row] for row in table_rows(self.path("groundtruth.txt"))]
        frames = []
        for stamp, image in color:
            depth_stamp, depth_image = depth[nearest_index([float(row[0]) for row in depth], float(stamp))]
            pose = poses[nearest_index([row[0] for row in poses], float(depth_stamp))]
            frames.append((self.path("label", os.path.basename(image)), self.path(depth_image),
                           self.path("depth_label", os.path.basename(depth_image)), transform(pose[1:8])))
        return frames

    def depth_number(self, frame):
        """The number of a frame's depth image in depth.txt."""
        return self.depth_paths().index(frame[1])

    def depth_paths(self):
        return [self.path(row[1]) for row in table_rows(self.path("depth.txt"))]

    def read_image(self, path):
        return np.asarray(Image.open(path)).astype(np.int64)

    def read_depth(self, path):
        """Planar z of every pixel, row-major, 0 where it is not to be used."""
        return self.depth_of(self.read_image(path))

    def depth_of(self, stored):
        """The same of an image's stored values."""
        z = stored / 5000.0
        usable = (z > 0) & (z >= self.depth["range_min_m"]) & (z <= self.depth["range_max_m"])
        return np.where(usable, z, 0.0)

    def classes_of(self, instances):
        classes = self.class_of[instances]
        if (classes < 0).any():
            raise ValueError(f"{self.folder}: an image holds an instance that recording.yaml does not list")
        return classes

    def cloud(self, z):
        """(H * W, 3) points in depth_optical."""
        v, u = np.indices(z.shape)
        x = (u - self.depth["cx_px"]) / self.depth["fx_px"]
        y = (v - self.depth["cy_px"]) / self.depth["fy_px"]
        return np.stack([z * x, z * y, z], axis=-1).reshape(-1, 3)

    def instance_geoms(self, T_map_world):
        """[(instance, shape in frame map)] of all drawn surfaces."""
        triangles, result = self.path("truth", "triangles.ply"), []
        if os.path.exists(triangles):
            result += read_triangles(triangles, T_map_world)
        with open(self.path("truth", "shapes.csv"), encoding="utf-8", newline="") as text:
            for row in csv.DictReader(text):
                pose = T_map_world @ transform([float(row[name]) for name in ("px", "py", "pz", "qx", "qy", "qz", "qw")])
                size = [float(row[name] or 0) for name in ("sx", "sy", "sz")]
                result.append((int(row["instance"]), KINDS[row["kind"]](pose[:3, :3], pose[:3, 3], size)))
        return result

    def geoms(self, T_map_world):
        """[(class, shape in frame map)] of all drawn surfaces."""
        return [(int(self.classes_of(instance)), shape) for instance, shape in self.instance_geoms(T_map_world)]
