# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Reads outlines drawn by hand and rasterises them; the header of polygons.txt defines the format."""

from dataclasses import dataclass, field

import numpy as np

WIDTH, HEIGHT = 640, 480


@dataclass
class Drawn:
    """An object in one frame: closed polygons, each with its sign and the line it stands in."""

    name: str
    rough: bool
    polygons: list = field(default_factory=list)  # (sign, N x 2 points in pixels, line)


@dataclass
class Drawing:
    instances: dict  # name -> (id, class); ids ascend from 1
    frames: dict  # number -> list of Drawn, those in front last

    def classes(self):
        """Names of classes in the order of their first instance."""
        return list(dict.fromkeys(name for _, name in self.instances.values()))


def corners(words):
    points = np.array([[float(number) for number in word.split(",")] for word in words])
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
        raise ValueError("a polygon needs three points X,Y or more")
    if not np.all((points >= -0.5) & (points <= [WIDTH - 0.5, HEIGHT - 0.5])):  # false for NaN too
        raise ValueError(f"a point lies outside of {WIDTH} x {HEIGHT}")
    return points


class Reader:
    def __init__(self):
        self.drawing, self.objects = Drawing({}, {}), None

    def instance(self, number, name, kind):
        if int(number) != len(self.drawing.instances) + 1 or name in self.drawing.instances:
            raise ValueError("ids must ascend from 1, each with a name of its own")
        self.drawing.instances[name] = int(number), kind

    def frame(self, number):
        if int(number) in self.drawing.frames:
            raise ValueError(f"frame {number} stands there twice")
        self.objects = self.drawing.frames[int(number)] = []

    def object(self, name, rough=None):
        if name not in self.drawing.instances or rough not in (None, "rough"):
            raise ValueError("object needs the name of an instance, and may be `rough`")
        if any(other.name == name for other in self.objects):
            raise ValueError(f"{name} stands twice in one frame")
        self.objects.append(Drawn(name, rough is not None))

    def line(self, words, number):
        if words[0] in "+-":
            self.objects[-1].polygons.append((words[0], corners(words[1:]), number))
        elif words[0] in ("instance", "frame", "object"):
            getattr(self, words[0])(*words[1:])
        else:
            raise ValueError(f"`{words[0]}` is none of instance, frame, object, + and -")


def read_drawing(path):
    """The Drawing of a file; ValueError names file and line of what is wrong."""
    reader = Reader()
    with open(path, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            words = line.split("#")[0].split()
            try:
                if words:
                    reader.line(words, number)
            except (TypeError, IndexError):
                raise ValueError(f"{path}:{number}: too many or too few words, or out of place") from None
            except ValueError as error:
                raise ValueError(f"{path}:{number}: {error}") from None
    if not reader.drawing.frames:
        raise ValueError(f"{path}: no frame")
    return reader.drawing


def inside(points):
    """HEIGHT x WIDTH booleans: pixels whose centre lies within a polygon, by the even-odd rule.

    A centre on the left or upper border is inside, one on the right or lower border is not.
    """
    crossings = np.zeros((HEIGHT, WIDTH + 1), np.int32)
    for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0)):
        (top, bottom) = sorted((y0, y1))
        rows = np.arange(int(np.ceil(top)), int(np.ceil(bottom)))
        if len(rows):
            x = x0 + (rows - y0) * (x1 - x0) / (y1 - y0)
            crossings[rows, np.clip(np.ceil(x).astype(int), 0, WIDTH)] += 1
    return np.cumsum(crossings, axis=1)[:, :WIDTH] % 2 == 1


def mask(drawn):
    """HEIGHT x WIDTH booleans of one object: its polygons added and taken away in their order."""
    pixels = np.zeros((HEIGHT, WIDTH), bool)
    for sign, points, _ in drawn.polygons:
        pixels = pixels | inside(points) if sign == "+" else pixels & ~inside(points)
    return pixels


def labels(drawing, frame):
    """HEIGHT x WIDTH uint16: the instance id of each pixel of a frame, 0 where nothing is drawn."""
    image = np.zeros((HEIGHT, WIDTH), np.uint16)
    for drawn in drawing.frames[frame]:
        image[mask(drawn)] = drawing.instances[drawn.name][0]
    return image
