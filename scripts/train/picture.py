# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Draws what networks see: a row a frame, with colours, true classes and the labels of each network.

    /usr/bin/python3 scripts/train/picture.py RECORDING --weights results/weights/fcn_nyu13_0.onnx ... --frames 3,17 -o networks.png
"""

import argparse
import pathlib

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import export
import nets
from data import HEIGHT, WIDTH, UNITS_PER_M, class_lists, folded, read

GAP, TITLE, KEY = 6, 34, 32
# One for each channel, background first; hues of things that stand side by side differ.
COLOURS = ["1a1a1a", "e377c2", "9467bd", "c7dbe8", "d62728", "b08d57", "8c564b", "ff7f0e", "ffd92f", "1f77b4",
           "17becf", "2ca02c", "d9d2b0", "aec7e8", "637939", "7b4173", "843c39", "3182bd", "e6550d", "bdbdbd"]
PALETTE = np.array([[int(c[n:n + 2], 16) for n in (0, 2, 4)] for c in COLOURS], np.uint8)
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"


def net_of(file):
    return file.stem.rsplit("_", 2)[0]


def labels_of(file, color, depth):
    """Channels with the greatest logit, HEIGHT x WIDTH, as OpenCV computes them."""
    image = color.astype(np.float32).transpose(2, 0, 1)[None]
    if nets.channels_of(net_of(file)) == 4:
        image = np.concatenate([image, depth.astype(np.float32)[None, None] / UNITS_PER_M], 1)
    return export.logits_of(file, np.ascontiguousarray(image))[0].argmax(0)


def sheet(rows, titles, names):
    """Images of HEIGHT x WIDTH x 3 in rows, under titles, above the key of the classes."""
    font = ImageFont.truetype(FONT, 22)
    width = len(titles) * (WIDTH + GAP) - GAP
    places, x, line = [], 4, 0
    for name in names:
        wide = 48 + int(font.getlength(name))
        if x + wide > width:
            x, line = 4, line + 1
        places.append((x, TITLE + len(rows) * (HEIGHT + GAP) + 4 + line * KEY))
        x += wide
    picture = Image.new("RGB", (width, TITLE + len(rows) * (HEIGHT + GAP) + (line + 1) * KEY + 4), "white")
    draw = ImageDraw.Draw(picture)
    for n, title in enumerate(titles):
        draw.text((n * (WIDTH + GAP) + 4, 4), title, "black", font)
    for r, row in enumerate(rows):
        for n, image in enumerate(row):
            picture.paste(Image.fromarray(image), (n * (WIDTH + GAP), TITLE + r * (HEIGHT + GAP)))
    for name, colour, (x, y) in zip(names, PALETTE, places):
        draw.rectangle((x, y + 2, x + 22, y + 24), tuple(colour), "black")
        draw.text((x + 30, y), name, "black", font)
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording")
    parser.add_argument("--weights", nargs="+", required=True, type=pathlib.Path, help="NET_CLASSES_SEED.onnx, a column each")
    parser.add_argument("--frames", default="0", help="numbers of frames, by commas [0]")
    parser.add_argument("-o", "--output", required=True, help="PNG to write")
    args = parser.parse_args()
    if missing := [str(file) for file in args.weights if not file.is_file()]:
        parser.error(f"there is no {missing[0]}; train it (scripts/train/train.sh) or mend the path")
    lists = {file.stem.rsplit("_", 2)[1] for file in args.weights}
    if len(lists) != 1:
        parser.error(f"networks of one list of classes stand side by side, these are of {', '.join(sorted(lists))}")
    color, depth, label, names = read(args.recording, keep=False)
    fold = class_lists()[lists.pop()]
    truth = folded(label, names, fold)
    frames = [int(n) for n in args.frames.split(",")]
    if bad := [n for n in frames if not 0 <= n < len(color)]:
        parser.error(f"--frames: there is no frame {bad[0]}; the recording has 0 to {len(color) - 1}")
    rows = [[color[n], PALETTE[truth[n]], *(PALETTE[labels_of(file, color[n], depth[n])] for file in args.weights)]
            for n in frames]
    titles = ["colour", "true classes", *map(net_of, args.weights)]
    sheet(rows, titles, ["background", *fold]).save(args.output)
    print(args.output)


if __name__ == "__main__":
    main()
