#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Measures, frame by frame, how far steps of depth lie from drawn outlines and from colour edges.

Nothing of mapscore's core is used. Reads the recording that make_recording.py wrote.
"""

import argparse
import pathlib
import sys

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_edt, gaussian_filter, map_coordinates

import polygons
from make_recording import DRAWN

REACH = 10  # px, largest shift tried along each axis
SIGMA = 1.5  # px, of the score of a distance to an outline
HOLE = 24  # px, longest run without depth across which a step is looked for
STEP = 0.08  # least relative step of depth
NEAR = 12  # px, steps farther than this from any outline are of other things
STEPS = {"left": (0, -1), "right": (0, 1), "top": (-1, 0), "bottom": (1, 0)}


def depth_steps(z):
    """Steps of a depth image (metres, 0 = none): N x 2 points u v, N sides, N depths of the nearer surface.

    A point lies half a pixel outside of the last pixel of the nearer surface, on the side that is named.
    """
    points, sides, depths = [], [], []
    for side, (dv, du) in STEPS.items():
        open_, done = z > 0, np.zeros(z.shape, bool)
        v, u = np.nonzero(open_)
        near = z[v, u]
        for distance in range(1, HOLE + 2):
            vv, uu = v + distance * dv, u + distance * du
            within = (vv >= 0) & (vv < z.shape[0]) & (uu >= 0) & (uu < z.shape[1])
            v, u, near, vv, uu = (a[within] for a in (v, u, near, vv, uu))
            far = z[vv, uu]
            step = (far > near * (1 + STEP)) & ~done[v, u]
            points.append(np.stack([u[step] + du / 2, v[step] + dv / 2], axis=1))
            sides += [side] * int(step.sum())
            depths.append(near[step])
            v, u, near = v[far == 0], u[far == 0], near[far == 0]
    return np.concatenate(points), np.array(sides), np.concatenate(depths)


def outline_distance(drawing, frame):
    """(2 HEIGHT + 1) x (2 WIDTH + 1) distances in pixels to outlines, on a lattice of half pixels from (-0.5, -0.5).

    Borders of what is rough are no outlines, and neither are those of the image.
    """
    image = polygons.labels(drawing, frame)
    rough = [drawing.instances[d.name][0] for d in drawing.frames[frame] if d.rough]
    fine = np.zeros((2 * polygons.HEIGHT + 1, 2 * polygons.WIDTH + 1), bool)
    for axis in (0, 1):
        a, b = (np.take(image, range(1, image.shape[axis]), axis), np.take(image, range(image.shape[axis] - 1), axis))
        v, u = np.nonzero((a != b) & ~np.isin(a, rough) & ~np.isin(b, rough))
        if axis == 0:
            fine[2 * v + 2, 2 * u + 1] = True
        else:
            fine[2 * v + 1, 2 * u + 2] = True
    return distance_transform_edt(~fine) / 2


def colour_edges(rgb):
    """Strength of colour edges in 0 to 1: gradients of brightness in root scale, so that dark parts count too."""
    smooth = gaussian_filter(np.sqrt(rgb.astype(float).mean(axis=2)), 1)
    gradient = np.hypot(*np.gradient(smooth))
    return np.minimum(1, gradient / np.percentile(gradient, 98))


def peak(scores):
    """Shift du dv of the best score, refined by a parabola along each axis, and that score."""
    v, u = np.unravel_index(np.argmax(scores), scores.shape)
    shift = [float(u), float(v)]
    if 0 < v < scores.shape[0] - 1 and 0 < u < scores.shape[1] - 1:
        for axis, (a, b, c) in enumerate([scores[v, u - 1 : u + 2], scores[v - 1 : v + 2, u]]):
            if a - 2 * b + c < 0:
                shift[axis] += 0.5 * (a - c) / (a - 2 * b + c)
    return shift[0] - REACH, shift[1] - REACH, scores[v, u]


def score_table(points, sample):
    """N x shifts x shifts scores of each point moved by each shift."""
    shifts = np.arange(-REACH, REACH + 1)
    return np.stack([np.stack([sample(points + [du, dv]) for du in shifts], 1) for dv in shifts], 1)


def spread(points, scores, draws=100):
    """Standard deviation of the peak when cells of 40 px are drawn anew with replacement."""
    _, cell = np.unique((points // 40).astype(int) @ [1000, 1], return_inverse=True)
    sums = np.zeros((cell.max() + 1, *scores.shape[1:]))
    np.add.at(sums, cell, scores)
    random = np.random.default_rng(1)
    drawn = [peak(sums[random.integers(len(sums), size=len(sums))].sum(0))[:2] for _ in range(draws)]
    return np.std(drawn, axis=0)


def drawn_onto_colour(recording, drawing, frame):
    """Points of the outlines, and their scores against colour edges: how well the outlines were drawn."""
    edges = colour_edges(np.asarray(Image.open(recording / f"color/{frame:06}.png")))
    points = np.argwhere(outline_distance(drawing, frame) == 0)[:, ::-1] / 2 - 0.5
    return points, score_table(points, lambda p: map_coordinates(edges, p.T[::-1], order=1, mode="nearest"))


def measure(recording, drawing, frame):
    """Points, sides and depths of the steps near outlines, and their scores against outlines and colour."""
    z = np.asarray(Image.open(recording / f"depth/{frame:06}.png"), float) / 5000
    rgb = np.asarray(Image.open(recording / f"color/{frame:06}.png"))
    points, sides, depths = depth_steps(z)
    distance, edges = outline_distance(drawing, frame), colour_edges(rgb)

    def distances(p):
        return map_coordinates(distance, [2 * p[:, 1] + 1, 2 * p[:, 0] + 1], order=1, mode="nearest")

    used = distances(points) < NEAR
    points, sides, depths = points[used], sides[used], depths[used]
    drawn = score_table(points, lambda p: np.exp(-0.5 * (distances(p) / SIGMA) ** 2))
    colour = score_table(points, lambda p: map_coordinates(edges, [p[:, 1], p[:, 0]], order=1, mode="nearest"))
    return points, sides, depths, drawn, colour


COLOURS = ["D02020", "0070C0", "009040", "B000B0", "C07000", "008080"]  # of outlines, by instance
VIEWS = {1: (345, 245), 4: (385, 125)}  # frames of the figure, and the corner of the enlarged part
PART, ENLARGED = 160, 3


def scene(recording, drawing, frame, scale, corner, size):
    """An RGB image of a part of a frame, enlarged: steps of depth black, outlines coloured, nothing of the images."""
    z = np.asarray(Image.open(recording / f"depth/{frame:06}.png"), float) / 5000
    picture = np.full((size[1] * scale, size[0] * scale, 3), 255, np.uint8)
    at = ((depth_steps(z)[0] - corner + 0.5) * scale - (scale > 1)).astype(int)
    for du in range(scale - (scale > 1)):
        for dv in range(scale - (scale > 1)):
            u, v = at[:, 0] + du, at[:, 1] + dv
            within = (u >= 0) & (v >= 0) & (u < picture.shape[1]) & (v < picture.shape[0])
            picture[v[within], u[within]] = 0
    labels = polygons.labels(drawing, frame)
    part = labels[corner[1] : corner[1] + size[1], corner[0] : corner[0] + size[0]]
    fine = part.repeat(scale, axis=0).repeat(scale, axis=1)
    rim = np.zeros(fine.shape, bool)
    rim[1:] |= fine[1:] != fine[:-1]
    rim[:, 1:] |= fine[:, 1:] != fine[:, :-1]
    order = np.zeros(len(drawing.instances) + 1, int)  # of drawing; the outline is that of the later of two
    for rank, drawn in enumerate(drawing.frames[frame], 1):
        order[drawing.instances[drawn.name][0]] = rank
    front = np.max([order[fine], order[np.roll(fine, 1, 0)], order[np.roll(fine, 1, 1)]], axis=0)
    palette = np.array([list(bytes.fromhex(c)) for c in COLOURS], np.uint8)
    picture[rim] = palette[np.argsort(order)[front + len(order) - 1 - order.max()][rim] % len(COLOURS)]
    return picture


def draw_figure(recording, drawing, path):
    """Two frames, whole and enlarged: PNG of some ten colours."""
    rows = []
    for frame, corner in VIEWS.items():
        whole = scene(recording, drawing, frame, 1, (0, 0), (polygons.WIDTH, polygons.HEIGHT))
        part = scene(recording, drawing, frame, ENLARGED, corner, (PART, PART))
        (u, v), end = corner, PART - 1
        whole[[v, v + end], u : u + PART] = 150
        whole[v : v + PART, [u, u + end]] = 150
        rows.append(np.hstack([whole, np.full((polygons.HEIGHT, 10, 3), 150, np.uint8), part]))
    bar = np.full((10, rows[0].shape[1], 3), 150, np.uint8)
    Image.fromarray(np.vstack([rows[0], bar, rows[1]])).quantize(16, dither=0).save(path, optimize=True)


def row(name, points, scores):
    du, dv, best = peak(scores.sum(0))
    error = spread(points, scores)
    still, best = scores[:, REACH, REACH].mean(), best / len(points)
    print(f"{name:24} {len(points):6} {du:+6.1f} {dv:+6.1f}  {error[0]:5.1f} {error[1]:5.1f}  {still:6.3f} {best:6.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="example:\n  tests/real/misregistration.py dining_room")  # fmt: skip
    parser.add_argument("recording", type=pathlib.Path, help="folder that make_recording.py wrote")
    parser.add_argument("--polygons", type=pathlib.Path, default=DRAWN, help="outlines (tests/data/dining_room)")
    parser.add_argument("--figure", type=pathlib.Path, help="PNG to write: steps of depth and outlines of two frames")
    options = parser.parse_args()
    try:
        drawing = polygons.read_drawing(options.polygons)
        all_frames = {frame: measure(options.recording, drawing, frame) for frame in sorted(drawing.frames)}
        if options.figure:
            draw_figure(options.recording, drawing, options.figure)
    except (OSError, ValueError) as error:
        print(f"misregistration: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    print("Shift of depth, in pixels, that brings its steps onto edges; its standard deviation; mean score")
    print(f"{'frame, edges':24} {'steps':>6} {'du':>6} {'dv':>6}  {'sd_u':>5} {'sd_v':>5}  {'at 0':>6} {'best':>6}")
    pooled = [np.concatenate(parts) for parts in zip(*all_frames.values())]
    pooled[0] = np.concatenate([f[0] + [0, 4000 * n] for n, f in all_frames.items()])  # cells of frames are apart
    for name, (points, sides, depths, drawn, colour) in {**all_frames, "all": pooled}.items():
        row(f"{name}, outlines", points, drawn)
        row(f"{name}, colour", points, colour)
    for frame in drawing.frames:
        row(f"{frame}, drawn onto colour", *drawn_onto_colour(options.recording, drawing, frame))
    points, sides, depths, drawn, colour = pooled
    for side in STEPS:
        row(f"all, {side} outlines", points[sides == side], drawn[sides == side])
    for name, some in {"below 1.8 m": depths < 1.8, "1.8 to 2.8 m": (depths >= 1.8) & (depths < 2.8),
                       "beyond 2.8 m": depths >= 2.8}.items():  # fmt: skip
        row(f"{name}, outlines", points[some], drawn[some])
    return 0


if __name__ == "__main__":
    sys.exit(main())
