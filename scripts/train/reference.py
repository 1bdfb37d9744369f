# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes what tests/network compares with: one frame, and PyTorch's logits of committed networks on it.

    scripts/train/reference.py IMAGE_COLOR.png IMAGE_DEPTH.png WEIGHTS.onnx... -o FOLDER

Reads each network's weights from its ONNX file, runs the file's graph in PyTorch's operators, node by node
(never in OpenCV), and writes every 16th pixel of the logits.
"""

import argparse
import pathlib
import sys

import cv2
import numpy as np
import onnx
import torch
from onnx import helper, numpy_helper
from torch.nn import functional as F

from data import UNITS_PER_M

STEP = 16


def sides(values):
    """ONNX's pads (top, left, bottom, right) as PyTorch's one pair; the sides must agree."""
    if values[:2] != values[2:]:
        raise SystemExit(f"pads {values} differ from side to side; export with symmetric ones")
    return values[:2]


def padded(x, pads):
    """ONNX's Pad of the four axes with zeros; PyTorch counts axes from the last."""
    begin, end = pads[:4], pads[4:]
    return F.pad(x, [int(n) for axis in (3, 2, 1, 0) for n in (begin[axis], end[axis])])


def resize(x, sizes, mode):
    if mode["mode"] != b"linear" or mode["coordinate_transformation_mode"] not in (b"pytorch_half_pixel", b"half_pixel"):
        raise SystemExit(f"Resize {mode} is none that this reads")
    return F.interpolate(x, size=[int(n) for n in sizes[2:]], mode="bilinear", align_corners=False)


OPERATORS = {
    "Add": lambda a, x, y: x + y, "Sub": lambda a, x, y: x - y, "Mul": lambda a, x, y: x * y,
    "Div": lambda a, x, y: x / y, "Relu": lambda a, x: F.relu(x), "Sigmoid": lambda a, x: torch.sigmoid(x),
    "Concat": lambda a, *x: torch.cat(x, a["axis"]),
    "Conv": lambda a, x, w, b=None: F.conv2d(x, w, b, a["strides"], sides(a["pads"]), a["dilations"], a["group"]),
    "AveragePool": lambda a, x: F.avg_pool2d(x, a["kernel_shape"], a["strides"], sides(a.get("pads", [0] * 4))),
    "MaxPool": lambda a, x: F.max_pool2d(x, a["kernel_shape"], a["strides"], sides(a.get("pads", [0] * 4))),
    "ReduceMean": lambda a, x: x.mean(a["axes"], keepdim=bool(a["keepdims"])),
    "ReduceMax": lambda a, x: x.amax(a["axes"], keepdim=bool(a["keepdims"])),
    "Shape": lambda a, x: torch.tensor(x.shape),
    "Slice": lambda a, x, begin, end, axis=None, step=None: x.narrow(
        int(axis), int(begin), min(int(end), x.shape[int(axis)]) - int(begin)),
    "Pad": lambda a, x, pads, value=None: padded(x, pads),
    "Resize": lambda a, x, roi, scales, sizes: resize(x, sizes, a),
}


def run(model, image):
    """Logits of the graph; each operator as PyTorch computes it."""
    values = {w.name: torch.from_numpy(numpy_helper.to_array(w).copy()) for w in model.graph.initializer}
    values["image"], values[""] = image, None
    for node in model.graph.node:
        attributes = {a.name: helper.get_attribute_value(a) for a in node.attribute}
        if node.op_type == "Constant":
            values[node.output[0]] = torch.from_numpy(numpy_helper.to_array(attributes["value"]).copy())
        elif node.op_type in OPERATORS:
            values[node.output[0]] = OPERATORS[node.op_type](attributes, *(values[i] for i in node.input))
        else:
            raise SystemExit(f"{node.op_type} is no operator that this reads; add it to OPERATORS")
    return values["logits"]


def image_of(color, depth, channels):
    rgb = cv2.imread(str(color), cv2.IMREAD_COLOR)[:, :, ::-1].astype(np.float32)
    if channels == 4:
        metres = cv2.imread(str(depth), cv2.IMREAD_UNCHANGED).astype(np.float32) / UNITS_PER_M
        rgb = np.concatenate([rgb, metres[..., None]], 2)
    return torch.from_numpy(np.ascontiguousarray(rgb.transpose(2, 0, 1)[None]))


def write(file, logits):
    """`K rows columns step`, then a line for each class and row: logits at (step r, step c)."""
    part = logits[0, :, ::STEP, ::STEP].numpy()
    lines = ["{} {} {} {}".format(*part.shape, STEP)]
    lines += [" ".join(f"{v:.9g}" for v in row) for plane in part for row in plane]
    file.write_text("\n".join(lines) + "\n")


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("color")
    parser.add_argument("depth")
    parser.add_argument("weights", nargs="+")
    parser.add_argument("-o", "--output", required=True)
    args = parser.parse_args(argv)
    torch.set_num_threads(1)
    for weights in map(pathlib.Path, args.weights):
        model = onnx.load(str(weights))
        channels = model.graph.input[0].type.tensor_type.shape.dim[1].dim_value
        with torch.no_grad():
            logits = run(model, image_of(args.color, args.depth, channels))
        write(pathlib.Path(args.output) / f"{weights.stem}.logits.txt", logits)


if __name__ == "__main__":
    main(sys.argv[1:])
