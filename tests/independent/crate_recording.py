# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Recordings of boxes before a wall; of one crate, whose scores are known by hand, with the ruler held against them."""

import os
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
OPTICAL_TO_BASE = (-0.5, 0.5, -0.5, 0.5)  # x right, y down, z forward -> x forward, y left, z up

@dataclass
class Scene:
    """Boxes as (instance, x, y, z ranges) before two cameras that look along world x from the height of 1 m."""
    boxes: tuple
    size: tuple  # rows, columns
    focal: float
    baseline: float = 0.0  # of the colour camera, to the right of the depth camera

    def seen(self, eye):
        """Planar depth and instance per pixel."""
        v, u = np.indices(self.size)
        cy, cx = ((count - 1) / 2 for count in self.size)
        ray = np.stack([np.ones(self.size), -(u - cx) / self.focal, -(v - cy) / self.focal], axis=-1)
        depth, instance = np.full(self.size, np.inf), np.zeros(self.size, int)
        for number, *ranges in self.boxes:
            first, last = np.zeros(self.size), np.full(self.size, np.inf)
            for axis, (low, high) in enumerate(ranges):
                a, b = (low - eye[axis]) / ray[..., axis], (high - eye[axis]) / ray[..., axis]
                first, last = np.maximum(first, np.minimum(a, b)), np.minimum(last, np.maximum(a, b))
            hit = (first <= last) & (first < depth)
            depth[hit], instance[hit] = first[hit], number
        return depth, instance

    def images(self):
        """Depth image in metres, its instances, and the instances of the colour image."""
        return *self.seen((0, 0, 1)), self.seen((0, -self.baseline, 1))[1]


WALL = (0, (3.0, 3.2), (-5, 5), (-4, 6))
CRATE = Scene(((1, (2.0, 2.2), (-0.3, 0.3), (0.7, 1.3)), WALL), (48, 64), 64.0)


def write_recording(folder, frames=2, scene=CRATE, depth=None, labels=None, T_color_depth=None):
    """Of the scene; a depth image in metres, label image and calibration may take the places of the true ones."""
    for name in ("color", "depth", "label", "depth_label", "truth"):
        os.makedirs(os.path.join(folder, name))
    true_depth, instance, true_labels = scene.images()
    depth, labels = true_depth if depth is None else depth, true_labels if labels is None else labels
    T_color_depth = (-scene.baseline, 0, 0, 0, 0, 0, 1) if T_color_depth is None else T_color_depth
    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as out:
            out.write(text)
    for n in range(frames):
        Image.fromarray(np.zeros((*scene.size, 3), np.uint8)).save(os.path.join(folder, "color", f"{n:06d}.png"))
        for name, image in (("depth", np.rint(depth * 5000)), ("label", labels), ("depth_label", instance)):
            Image.fromarray(image.astype(np.uint16)).save(os.path.join(folder, name, f"{n:06d}.png"))
    for name in ("color", "depth"):
        write(f"{name}.txt", "# stamp file\n" + "".join(f"{n}.5 {name}/{n:06d}.png\n" for n in range(frames)))
    write("groundtruth.txt", "".join(f"{n}.5 0 0 0 0 0 0 1\n" for n in range(frames)))
    (height, width), focal = scene.size, scene.focal
    camera = (f"{{width_px: {width}, height_px: {height}, fx_px: {focal}, fy_px: {focal}, cx_px: {(width - 1) / 2}, "
              f"cy_px: {(height - 1) / 2}, rate_hz: 1")
    crates = range(1, max(labels.max(), *(number for number, *_ in scene.boxes)) + 1)
    write("recording.yaml", f"""format_version: 1
scene: ""
scene_hash: ""
mujoco_version: ""
seed: 1
frame_count: {frames}
has_truth: true
color: {camera}}}
depth: {camera}, range_min_m: 0.6, range_max_m: 8}}
T_color_depth: [{", ".join(map(str, T_color_depth))}]
T_base_depth: [0, 0, 1, {", ".join(map(str, OPTICAL_TO_BASE))}]
classes:
  - {{id: 0, name: background, colour: "808080", detect: false}}
  - {{id: 1, name: crate, colour: "FF0000", detect: true}}
instances:
  - {{id: 0, name: background, class: 0}}
""" + "".join(f"  - {{id: {n}, name: crate_{n}, class: 1}}\n" for n in crates))
    rows = ["kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz"]
    for number, *ranges in scene.boxes:
        centre, half = [(a + b) / 2 for a, b in ranges], [(b - a) / 2 for a, b in ranges]
        rows.append(",".join(map(str, ["box", number, "geom", *centre, 0, 0, 0, 1, *half])))
    write("truth/shapes.csv", "\n".join(rows) + "\n")


def run(folder, *flags):
    command = [sys.executable, os.path.join(HERE, "ruler.py"), *flags[:flags[:1] == ("truth",)], folder,
               "--voxel_m", "0.1", "--origin_m", "-0.03", "0", "0", *flags[flags[:1] == ("truth",):]]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [line.split(",") for line in lines[1:]]


def counts(folder, *flags):
    return {metric: float(value) if value != "-" else None for _, metric, value in run(folder, *flags)}


def check_recording(folder, expect):
    """The crate fills columns 22..41 and rows 14..33 at 2 m: 400 pixels, 6 x 6 voxels. See CRATE."""
    def pick(result, *names):
        return [result[name] for name in names]
    main = ("predicted", "true_predicted", "visible", "found", "samples")
    wrong = ("false_near", "false_leak", "false_floating", "missed_mislabelled", "missed_unlabelled", "missed_unmapped")

    result = counts(folder)
    expect("dose zero, fused", pick(result, *main), [36, 36, 36, 36, 800])
    expect("dose zero: no error", pick(result, *wrong), [0] * 6)
    expect("dose zero: distances", pick(result, "precise_1cm", "complete_1cm", "accuracy_mean_m", "completeness_mean_m"),
           [36, 800, 0, 0])
    expect("dose zero, by frame", pick(counts(folder, "--unit", "frame"), *main), [72, 72, 72, 72, 800])
    expect("lattice ceiling", pick(counts(folder, "--labels", "depth_label"), *main), [36, 36, 36, 36, 800])

    # 62.5 mm: the crate moves by 2 px, the wall by 1.33. Mask column 22 shows the wall (depth column 21), 23 is a
    # hole, the crate is seen up to depth column 39. Wall voxels: y 0.492 -> 4, z 0.555..1.445 -> 5..14.
    shifted = ("--misregistration_m", "0.0625", "0", "0")
    result = counts(folder, *shifted)
    expect("misregistration leaks", pick(result, *main), [46, 36, 36, 36, 800])
    expect("causes", pick(result, *wrong), [0, 10, 0, 0, 0, 0])
    far = (8 * np.hypot(0.77, 0.1) + 2 * np.sqrt(0.77**2 + 0.02)) / 46
    expect("accuracy", pick(result, "precise_10cm", "accuracy_mean_m"), [36, far], 1e-8)
    result = counts(folder, *shifted, "--method", "region_growing")
    expect("growing stays on the crate", pick(result, *main), [36, 36, 36, 36, 800])
    # eroded by 2 px: columns 24..39 show depth columns 22..37, y 0.297..-0.172; rows 16..31, z 0.766..1.234
    result = counts(folder, *shifted, "--method", "erosion", "--radius_px", "2")
    expect("erosion", pick(result, *main) + [result["missed_unmapped"]], [5 * 6, 30, 36, 30, 800, 6])
    # Rows of missed voxels hold depth columns 38..41; each predicted cube ends at y = -0.2. Found within 1 voxel: all.
    expect("found_t1", result["found_t1"], 36)
    # samples at y = -0.2031, -0.2344, -0.2656, -0.2969 lie 3, 34, 66, 97 mm away, 20 rows, 2 frames
    expect("complete", pick(result, "complete_1cm", "complete_2cm", "complete_5cm", "complete_10cm"),
           [680, 680, 720, 800])
    # a tilt of 1.790 deg about the colour camera's y axis moves all by +2 px: column 22 shows wall column 20,
    # 23 wall column 21; nothing is torn because the tilt shifts all depths alike. z: 1.79 deg keeps rows within 0.1 px.
    tilted = ("--rotation_deg", "0", str(np.degrees(2 / CRATE.focal)), "0")
    result = counts(folder, *tilted)
    expect("rotation leaks two columns", pick(result, "predicted", "true_predicted", "false_leak"), [56, 36, 20])
    # place voxels: centres of sensor voxels x 0.1 k + 0.05 ... z 2.05 -> map x 2.08, y and z shift to the same cells
    expect("place voxels", pick(counts(folder, "--place", "voxels"), *main), [36, 36, 36, 36, 800])

    rows = run(folder, "truth")
    expect("truth rows", (len(rows), sum(row[4] == "1" for row in rows)), (176, 104))
    expect("truth samples", (sum(int(row[5]) for row in rows), sum(row[5] != "0" for row in rows)), (800, 36))
