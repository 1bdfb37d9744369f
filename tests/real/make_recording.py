#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Makes a recording of five real frames of a Kinect, with labels drawn by hand and without truth."""

import argparse
import pathlib
import shutil
import sys

import numpy as np
from PIL import Image

import polygons

DRAWN = pathlib.Path(__file__).parent.parent / "data" / "dining_room" / "polygons.txt"
CAMERA = "width_px: 640, height_px: 480, fx_px: 518, fy_px: 519, cx_px: 325.5, cy_px: 253.5, rate_hz: 1"
RANGE_MM = 400, 10000
COLOURS = {
    "chair": "E0A000", "armchair": "2860A0", "table": "A04020", "coffee_table": "D060D0", "sideboard": "008070",
    "chest": "60B030", "cabinet": "803090", "sofa": "E06080", "candle": "F0E040", "tableware": "40C0E0",
}  # fmt: skip
EXAMPLE = """example:
  git clone https://github.com/gaoxiang12/slambook
  git -C slambook checkout 853abac
  tests/real/make_recording.py slambook/ch5/joinMap dining_room
  mapscore map dining_room --voxel_m 0.05 --segmentation edge_aligned -o dining_room.ot
"""


def product(p, q):
    """Of two quaternions x y z w."""
    v = p[3] * q[:3] + q[3] * p[:3] + np.cross(p[:3], q[:3])
    return np.append(v, p[3] * q[3] - p[:3] @ q[:3])


# From axes of a camera (x right, y down, z ahead) to those of a robot (x ahead, y left, z up).
AHEAD = np.array([-0.5, 0.5, -0.5, 0.5])
BACK = AHEAD * [-1, -1, -1, 1]


def poses(path, count):
    """T_world_base of each frame, x y z qx qy qz qw; world is about the first camera, turned so that z is up."""
    rows = np.loadtxt(path, ndmin=2)
    if rows.shape != (count, 7):
        raise ValueError(f"{path}: {rows.shape} numbers, not {count} lines of x y z qx qy qz qw")
    if np.any(np.abs(np.linalg.norm(rows[:, 3:], axis=1) - 1) > 1e-3):
        raise ValueError(f"{path}: a quaternion is not of unit length")
    turned = [product(product(AHEAD, row[3:]), BACK) for row in rows]
    return np.hstack([rows[:, [2, 0, 1]] * [1, -1, -1], turned])


def image(path, mode, dtype):
    pixels = np.asarray(Image.open(path).convert(mode), dtype)
    if pixels.shape[:2] != (polygons.HEIGHT, polygons.WIDTH):
        raise ValueError(f"{path}: {pixels.shape[1]} x {pixels.shape[0]} pixels, not 640 x 480")
    return pixels


def head(drawing):
    """Text of recording.yaml."""
    kinds = drawing.classes()
    lines = [
        "format_version: 1",
        'scene: "dining_room"',
        f'scene_hash: "{"0" * 32}"',
        'mujoco_version: ""',
        "seed: 1",
        f"frame_count: {len(drawing.frames)}",
        "has_truth: false",
        f"color: {{{CAMERA}}}",
        f"depth: {{{CAMERA}, range_min_m: {RANGE_MM[0] / 1000}, range_max_m: {RANGE_MM[1] / 1000}}}",
        "T_color_depth: [0, 0, 0, 0, 0, 0, 1]",
        f"T_base_depth: [0, 0, 0, {', '.join(map(str, AHEAD))}]",
        "classes:",
        '  - {id: 0, name: "background", colour: "808080", detect: false}',
    ]
    for number, kind in enumerate(kinds, 1):
        lines.append(f'  - {{id: {number}, name: "{kind}", colour: "{COLOURS.get(kind, "C0C0C0")}", detect: true}}')
    lines += ["instances:", '  - {id: 0, name: "background", class: 0}']
    for name, (number, kind) in drawing.instances.items():
        lines.append(f'  - {{id: {number}, name: "{name}", class: {kinds.index(kind) + 1}}}')
    return "\n".join(lines) + "\n"


def write(drawing, images, output):
    """Reads all input before it writes anything."""
    frames = sorted(drawing.frames)
    T_world_base = poses(images / "pose.txt", len(frames))
    depth = [image(images / f"depth/{n}.pgm", "I", np.int64) for n in frames]
    colour = [image(images / f"color/{n}.png", "RGB", np.uint8) for n in frames]

    for name in ("color", "depth", "label"):
        (output / name).mkdir(parents=True)
    lists = {"color": "", "depth": "", "groundtruth": ""}
    for n, z_mm, rgb, pose in zip(frames, depth, colour, T_world_base):
        seen = (z_mm > RANGE_MM[0]) & (z_mm < RANGE_MM[1])
        pictures = {"color": rgb, "depth": np.where(seen, 5 * z_mm, 0).astype(np.uint16),
                    "label": polygons.labels(drawing, n)}  # fmt: skip
        for name, pixels in pictures.items():
            Image.fromarray(pixels).save(output / name / f"{n:06}.png")
        for name in ("color", "depth"):
            lists[name] += f"{n} {name}/{n:06}.png\n"
        lists["groundtruth"] += f"{n} {' '.join(repr(float(number)) for number in pose)}\n"
    for name, text in {**lists, "rgb": lists["color"]}.items():
        (output / f"{name}.txt").write_text(text)
    (output / "recording.yaml").write_text(head(drawing))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__ + "\nThe source of the images is named in tests/data/dining_room/polygons.txt.",
        epilog=EXAMPLE, formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("images", type=pathlib.Path, help="folder with color/, depth/ and pose.txt")
    parser.add_argument("output", type=pathlib.Path, help="folder to make: images, labels, lists, recording.yaml")
    parser.add_argument("--polygons", type=pathlib.Path, default=DRAWN, help="outlines (tests/data/dining_room)")
    options = parser.parse_args()
    try:
        drawing = polygons.read_drawing(options.polygons)
        if options.output.exists():
            raise ValueError(f"{options.output} exists; remove it first")
        aside = options.output.with_name(options.output.name + ".part")
        shutil.rmtree(aside, ignore_errors=True)
        write(drawing, options.images, aside)
        aside.rename(options.output)
    except (OSError, ValueError) as error:
        print(f"make_recording: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    print(f"{options.output}: {len(drawing.frames)} frames, {len(drawing.instances)} instances drawn by hand")
    return 0


if __name__ == "__main__":
    sys.exit(main())
