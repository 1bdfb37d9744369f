#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Checks the drawn outlines, their rasteriser, the recording made of them and the measurement, without the images.

Exit 1 and a line for each thing that is not as it should be. `check.py MAPSCORE` also maps a recording of made-up
images.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

import make_recording
import misregistration
import polygons

# Visible pixels of each instance id, frame by frame.
AREAS = {
    1: {1: 5946, 2: 8702, 3: 14788, 4: 1488, 5: 1658, 6: 3843, 7: 7362, 8: 49593, 10: 8141, 11: 4691, 12: 14587, 13: 1596, 14: 376, 15: 379},
    2: {1: 9522, 2: 12359, 4: 2234, 7: 8696, 8: 6684, 9: 1201, 10: 16263, 11: 3798, 13: 4791, 16: 2212},
    3: {1: 18445, 4: 3930, 7: 13461, 8: 10485, 9: 1284, 10: 32266, 11: 4917, 13: 8254, 16: 4915},
    4: {1: 10339, 4: 8108, 7: 20161, 8: 2886, 9: 1819, 10: 31274, 11: 7020, 13: 12230, 16: 8784},
    5: {4: 5270, 7: 24264, 9: 1996, 10: 35006, 11: 7468, 13: 13095, 16: 12187},
}  # fmt: skip
wrong = []


def expect(what, is_, should):
    if is_ != should:
        wrong.append(f"{what}: {is_}, not {should}")


def crossing(points):
    """Whether two edges of a closed polygon cross, other than at the corner that they share."""
    a, b = points, np.roll(points, -1, axis=0)

    def side(p, q, r):
        return np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    for i in range(len(points)):
        for j in range(i + 2, len(points) - (i == 0)):
            parted = side(a[i], b[i], a[j]) * side(a[i], b[i], b[j]) < 0
            if parted and side(a[j], b[j], a[i]) * side(a[j], b[j], b[i]) < 0:
                return True
    return False


def read_text(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "polygons.txt"
        path.write_text(text)
        return polygons.read_drawing(path)


def check_rasteriser():
    square = polygons.inside(np.array([[2, 1], [5, 1], [5, 3], [2, 3]], float))
    expect("square", np.argwhere(square).tolist(), [[1, 2], [1, 3], [1, 4], [2, 2], [2, 3], [2, 4]])
    diamond = polygons.inside(np.array([[10, 6.5], [13.5, 10], [10, 13.5], [6.5, 10]]))
    expect("diamond, a row after the other", diamond.sum(axis=1)[6:15].tolist(), [0, 1, 3, 5, 7, 5, 3, 1, 0])
    frame = polygons.inside(np.array([[-0.5, -0.5], [639.5, -0.5], [639.5, 479.5], [-0.5, 479.5]]))
    expect("the whole image", int(frame.sum()), 640 * 480)
    two = "instance 1 a_1 a\ninstance 2 b_1 b\nframe 1\n"
    far = "object a_1\n+ 0,0 10,0 10,10 0,10\n"
    near = "object b_1\n+ 5,0 15,0 15,10 5,10\n- 6,1 9,1 9,4 6,4\n"
    image = polygons.labels(read_text(two + far + near), 1)
    expect("far one with what shows through the hole", int((image == 1).sum()), 50 + 9)
    expect("near one", int((image == 2).sum()), 100 - 9)
    expect("order", int((polygons.labels(read_text(two + near + far), 1) == 1).sum()), 100)


def check_refusals():
    head = "instance 1 a_1 a\nframe 1\nobject a_1\n"
    for what, text, line in [
        ("a point outside", head + "+ 0,0 640,0 5,5\n", 4), ("two points", head + "+ 0,0 5,0\n", 4),
        ("NaN", head + "+ 0,0 nan,0 5,5\n", 4), ("no number", head + "+ 0,0 x,0 5,5\n", 4),
        ("an unknown name", head + "object b_1\n", 4), ("a doubled object", head + "object a_1\n", 4),
        ("a doubled frame", head + "frame 1\n", 4), ("an id left out", "instance 2 a_1 a\n", 1),
        ("a polygon of nothing", "+ 0,0 1,1 2,0\n", 1), ("an unknown word", head + "polygon 1,1\n", 4),
    ]:  # fmt: skip
        try:
            read_text(text)
            wrong.append(f"{what}: not refused")
        except ValueError as error:
            expect(f"line of {what}", f"polygons.txt:{line}:" in str(error), True)


def check_drawing(drawing):
    expect("frames", list(drawing.frames), [1, 2, 3, 4, 5])
    expect("ids", [number for number, _ in drawing.instances.values()], list(range(1, 17)))
    for frame, objects in drawing.frames.items():
        for drawn in objects:
            shape = np.zeros((polygons.HEIGHT, polygons.WIDTH), bool)
            for sign, points, line in drawn.polygons:
                expect(f"line {line}: crosses itself", crossing(points), False)
                filled = polygons.inside(points)
                changed = filled & (shape if sign == "-" else ~shape)
                expect(f"line {line}: changes pixels", bool(changed.any()), True)
                shape = shape & ~filled if sign == "-" else shape | filled
        ids, counts = np.unique(polygons.labels(drawing, frame), return_counts=True)
        areas = {int(i): int(n) for i, n in zip(ids, counts) if i}
        expect(f"areas of frame {frame}", areas, AREAS.get(frame))


def made_up_images(drawing, folder, du, dv):
    """Depth as drawn, what is drawn later nearer, moved by du, dv pixels; colours as drawn."""
    for name in ("color", "depth"):
        (folder / name).mkdir()
    for frame, objects in drawing.frames.items():
        depth_mm = np.full((polygons.HEIGHT, polygons.WIDTH), 8000, np.uint16)
        for order, drawn in enumerate(objects):
            depth_mm[polygons.mask(drawn)] = 6000 - 450 * order
        grey = (depth_mm // 40).astype(np.uint8)
        Image.fromarray(np.stack([grey] * 3, axis=2)).save(folder / f"color/{frame}.png")
        moved = np.roll(depth_mm, (dv, du), axis=(0, 1))
        moved[0, :3] = 300, 400, 10000  # at the limits of the range or nearer: none
        (folder / f"depth/{frame}.pgm").write_bytes(b"P5\n640 480\n65535\n" + moved.astype(">u2").tobytes())
    (folder / "pose.txt").write_text("1 2 3 0 0 0 1\n" * 4 + "1 2 3 0 0.6 0 0.8\n")


def check_recording(drawing, program):
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        images, recording = work / "images", work / "recording"
        images.mkdir()
        made_up_images(drawing, images, 3, -2)
        script = [sys.executable, "-B", pathlib.Path(__file__).parent / "make_recording.py"]
        expect("exit code", subprocess.run([*script, images, recording], stdout=subprocess.DEVNULL).returncode, 0)
        depth = np.asarray(Image.open(recording / "depth/000001.png"))
        expect("depth, 1/5000 m", depth[0, :4].tolist(), [0, 0, 0, 40000])
        label = np.asarray(Image.open(recording / "label/000002.png"))
        expect("label image", np.array_equal(label, polygons.labels(drawing, 2)), True)
        lines = (recording / "groundtruth.txt").read_text().splitlines()
        expect("pose, z up", [float(x) for x in lines[0].split()], [1, 3, -1, -2, 0, 0, 0, 1])
        turned = [round(float(x), 9) for x in lines[4].split()]  # to the camera's right: clockwise from above
        expect("turn, z up", turned, [5, 3, -1, -2, 0, 0, -0.6, 0.8])
        bad = {"folder that exists": [images, recording], "no images": [work / "none", work / "b"]}
        for what, arguments in bad.items():
            failed = subprocess.run([*script, *arguments], stderr=subprocess.PIPE, text=True)
            expect(what, (failed.returncode, failed.stderr.count("\n")), (2, 1))
        _, sides, _, drawn, colour = misregistration.measure(recording, drawing, 3)
        one_side = {f"{side} outlines": drawn[sides == side] for side in misregistration.STEPS}
        for what, scores in {"outlines": drawn, "colour": colour, **one_side}.items():
            shift = np.array(misregistration.peak(scores.sum(0))[:2])
            expect(f"shift by {what}, {shift}: -3, 2 to 0.3 px", bool(np.all(np.abs(shift - [-3, 2]) < 0.3)), True)
        for verb in [["info", recording], ["map", recording, "-o", work / "map.ot", "-q"],
                     ["segment", recording, "-o", work / "segments"]] if program else []:  # fmt: skip
            done = subprocess.run([program, *verb], stdout=subprocess.DEVNULL)
            expect(f"exit code of mapscore {verb[0]}", done.returncode, 0)


def main():
    drawing = polygons.read_drawing(make_recording.DRAWN)
    check_rasteriser()
    check_refusals()
    check_drawing(drawing)
    check_recording(drawing, sys.argv[1] if len(sys.argv) > 1 else None)
    for line in wrong:
        print(f"tests/real: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
