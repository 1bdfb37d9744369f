# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A recording of a crate before a wall, whose scores are known by hand, and the ruler held against them."""

import os
import subprocess
import sys

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
OPTICAL_TO_BASE = (-0.5, 0.5, -0.5, 0.5)  # x right, y down, z forward -> x forward, y left, z up

BOXES = [(1, (2.0, 2.2), (-0.3, 0.3), (0.7, 1.3)), (0, (3.0, 3.2), (-5, 5), (-4, 6))]  # instance, x, y, z ranges
SIZE, FOCAL = (48, 64), 64.0


def cast(eye):
    """Planar depth and instance per pixel, looking along world x."""
    v, u = np.indices(SIZE)
    ray = np.stack([np.ones(SIZE), -(u - 31.5) / FOCAL, -(v - 23.5) / FOCAL], axis=-1)
    depth, instance = np.full(SIZE, np.inf), np.zeros(SIZE, int)
    for number, *ranges in BOXES:
        first, last = np.zeros(SIZE), np.full(SIZE, np.inf)
        for axis, (low, high) in enumerate(ranges):
            a, b = (low - eye[axis]) / ray[..., axis], (high - eye[axis]) / ray[..., axis]
            first, last = np.maximum(first, np.minimum(a, b)), np.minimum(last, np.maximum(a, b))
        hit = (first <= last) & (first < depth)
        depth[hit], instance[hit] = first[hit], number
    return depth, instance


def write_recording(folder, frames=2):
    for name in ("color", "depth", "label", "depth_label", "truth"):
        os.makedirs(os.path.join(folder, name))
    depth, instance = cast((0, 0, 1))
    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as out:
            out.write(text)
    for n in range(frames):
        for name, image in (("depth", np.rint(depth * 5000)), ("label", instance), ("depth_label", instance)):
            Image.fromarray(image.astype(np.uint16)).save(os.path.join(folder, name, f"{n:06d}.png"))
    for name in ("color", "depth"):
        write(f"{name}.txt", "# stamp file\n" + "".join(f"{n}.5 {name}/{n:06d}.png\n" for n in range(frames)))
    write("groundtruth.txt", "".join(f"{n}.5 0 0 0 0 0 0 1\n" for n in range(frames)))
    camera = "{width_px: 64, height_px: 48, fx_px: 64, fy_px: 64, cx_px: 31.5, cy_px: 23.5, rate_hz: 1"
    pose = ", ".join(map(str, OPTICAL_TO_BASE))
    write("recording.yaml", f"""format_version: 1
frame_count: {frames}
has_truth: true
color: {camera}}}
depth: {camera}, range_min_m: 0.6, range_max_m: 8}}
T_color_depth: [0, 0, 0, 0, 0, 0, 1]
T_base_depth: [0, 0, 1, {pose}]
classes:
  - {{id: 0, name: background, colour: "808080", detect: false}}
  - {{id: 1, name: crate, colour: "FF0000", detect: true}}
instances:
  - {{id: 0, name: background, class: 0}}
  - {{id: 1, name: crate_1, class: 1}}
""")
    rows = ["kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz"]
    for number, *ranges in BOXES:
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
    """The crate fills columns 22..41 and rows 14..33 at 2 m: 400 pixels, 6 x 6 voxels. See BOXES."""
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
    tilted = ("--rotation_deg", "0", str(np.degrees(2 / FOCAL)), "0")
    result = counts(folder, *tilted)
    expect("rotation leaks two columns", pick(result, "predicted", "true_predicted", "false_leak"), [56, 36, 20])
    # place voxels: centres of sensor voxels x 0.1 k + 0.05 ... z 2.05 -> map x 2.08, y and z shift to the same cells
    expect("place voxels", pick(counts(folder, "--place", "voxels"), *main), [36, 36, 36, 36, 800])

    rows = run(folder, "truth")
    expect("truth rows", (len(rows), sum(row[4] == "1" for row in rows)), (176, 104))
    expect("truth samples", (sum(int(row[5]) for row in rows), sum(row[5] != "0" for row in rows)), (800, 36))
