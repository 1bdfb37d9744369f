# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Floors, walls with openings, windows with a garden behind, doors, radiators, skirting."""

HEIGHT = 2.507  # of the rooms
DOOR = 2.053  # of door openings


def floor(scene, x0, x1, y0, y1, material):
    scene.body("floor", fixed=True).box(
        (x0 + x1) / 2, (y0 + y1) / 2, -0.1, x1 - x0, y1 - y0, 0.1, material
    )


def ceiling(scene, x0, x1, y0, y1):
    scene.body("ceiling", fixed=True).box(
        (x0 + x1) / 2, (y0 + y1) / 2, HEIGHT, x1 - x0, y1 - y0, 0.1, "ceiling"
    )


def wall(scene, axis, at, thick, start, end, material, gaps=(), skirting=(-1, 1)):
    """Along `axis` ('x' or 'y') from start to end, its middle at `at` across.

    gaps: (start, end, sill, lintel); skirting: its sides.
    """
    body = scene.body("wall", fixed=True)

    def part(a, b, low, high):
        if b - a < 1e-6 or high - low < 1e-6:
            return
        middle, length = (a + b) / 2, b - a
        if axis == "x":
            body.box(middle, at, low, length, thick, high - low, material)
        else:
            body.box(at, middle, low, thick, length, high - low, material)
        for side in skirting if low == 0 else ():
            out = at + side * (thick / 2 + 0.006)
            x, y, dx, dy = (
                (middle, out, length, 0.012) if axis == "x" else (out, middle, 0.012, length)
            )
            body.box(x, y, 0, dx, dy, 0.083 if axis == "y" else 0.081, "white")

    here = start
    for a, b, sill, lintel in sorted(gaps):
        part(here, a, 0, HEIGHT)
        part(a, b, 0, sill)
        part(a, b, lintel, HEIGHT)
        here = b
    part(here, end, 0, HEIGHT)


def window(scene, axis, at, thick, a, b, sill, lintel, outside):
    """Frame in the gap a..b of a wall, and the garden 20 cm behind it.

    Outside: +1 or -1 across the wall.
    """
    frame = scene.body("window", fixed=True)
    bar, deep = 0.055, 0.052

    def part(lo, hi, low, high):
        middle, length = (lo + hi) / 2, hi - lo
        x, y, dx, dy = (middle, at, length, deep) if axis == "x" else (at, middle, deep, length)
        frame.box(x, y, low, dx, dy, high - low, "white")

    part(a, b, sill, sill + bar)
    part(a, b, lintel - bar, lintel)
    for lo, hi in ((a, a + bar), ((a + b) / 2 - 0.037, (a + b) / 2 + 0.037), (b - bar, b)):
        part(lo, hi, sill + bar, lintel - bar)
    ledge = at - outside * (thick / 2 + 0.03)
    x, y, dx, dy = (
        ((a + b) / 2, ledge, b - a + 0.12, 0.2)
        if axis == "x"
        else (ledge, (a + b) / 2, 0.2, b - a + 0.12)
    )
    frame.box(x, y, sill - 0.033, dx, dy, 0.03, "white")
    back = at + outside * (thick / 2 + 0.2)
    facing = {("x", 1): "-y", ("x", -1): "+y", ("y", 1): "-x", ("y", -1): "+x"}[(axis, outside)]
    x, y = ((a + b) / 2, back) if axis == "x" else (back, (a + b) / 2)
    scene.body("sky", fixed=True).panel(
        x, y, (sill + lintel) / 2, b - a + 1.0, lintel - sill + 0.8, 0.04, "garden", facing
    )


def curtains(scene, axis, at, a, b, inside, material="drape", z=2.36):
    """A pair at the ends of a..b on a rod.

    Inside: +1 or -1, towards the room, `at` is the wall's face.
    """
    for side, where in ((-1, a - 0.1), (1, b + 0.1)):
        x, y, yaw = (where, at + inside * 0.1, 90) if axis == "x" else (at + inside * 0.1, where, 0)
        scene.body("curtain", x, y, z - 0.02, yaw=yaw, item=True).mesh("curtain", 0, 0, 0, material)
    rod = scene.parts[-1]
    reach = b - a + 0.7
    shift = -(b - a + 0.2) / 2
    rod.bar((0, shift - reach / 2, 0.03), (0, shift + reach / 2, 0.03), 0.013, "dark", "cylinder")


def radiator(scene, x, y, yaw, width=0.9):
    """Under a window; the origin lies on the wall."""
    body = scene.body("radiator", x, y, 0, yaw)
    body.box(0.075, 0, 0.16, 0.03, width, 0.5, "white")
    for i in range(int(width / 0.075)):
        body.box(0.095, -width / 2 + 0.045 + 0.075 * i, 0.175, 0.025, 0.045, 0.47, "white")
    body.box(0.03, 0, 0.5, 0.06, 0.3, 0.03, "white")


def door_closed(scene, x, y, yaw, width=0.92, material="oak"):
    """In its frame on a wall; the origin lies on the wall's face, +x into the room."""
    body = scene.body("door", x, y, 0, yaw)
    for side in (-1, 1):
        body.box(0.011, side * (width / 2 + 0.035), 0, 0.034, 0.07, DOOR + 0.03, "white")
    body.box(0.011, 0, DOOR - 0.04, 0.032, width, 0.07, "white")
    leaf(body, 0.006, -width / 2 + 0.003, width - 0.006, material)


def door_open(scene, x, y, yaw, width=0.9, material="oak"):
    """A leaf that stands open: hinge at (x, y), the leaf runs along its +y, thickness along x."""
    leaf(scene.body("door", x, y, 0, yaw), 0, 0.01, width, material, both=True)


def leaf(body, x, y, width, material, both=False):
    body.box(x, y + width / 2, 0.008, 0.038, width, DOOR - 0.05, material)
    for side in (1, -1) if both else (1,):
        face = x + side * 0.02
        for low, high in ((0.16, 0.86), (1.09, 1.87)):
            body.box(face, y + width / 2, low, 0.008, width - 0.3, high - low, "birch")
        edge = y + width - 0.07
        body.bar(
            (face + side * 0.045, edge, 1.03),
            (face + side * 0.045, edge - 0.12, 1.03),
            0.009,
            "steel",
        )
        body.bar((face, edge, 1.03), (face + side * 0.045, edge, 1.03), 0.009, "steel")


def frame(scene, axis, at, thick, a, b, material="white"):
    """The lining of an opening a..b in a wall (a door's frame without its leaf)."""
    body = scene.body("door", fixed=True)
    deep, bar = thick + 0.024, 0.027
    for lo, hi, low, high in (
        (a, a + bar, 0.001, DOOR),
        (b - bar, b, 0.001, DOOR),
        (a, b, DOOR - bar - 0.001, DOOR - 0.001),
    ):
        middle, length = (lo + hi) / 2, hi - lo
        if high < DOOR or low < 0.01:
            x, y, dx, dy = (middle, at, length, deep) if axis == "x" else (at, middle, deep, length)
            body.box(x, y, low, dx, dy, high - low - (bar + 0.002 if low < 0.01 else 0), material)


def picture(scene, x, y, z, yaw, width, height, material, rim="walnut"):
    """Hangs on the wall at (x, y), z its middle."""
    body = scene.body("picture", x, y, z, yaw, item=True)
    body.box(0.012, 0, -height / 2, 0.02, width, height, rim)
    body.panel(0.022, 0, 0, width - 0.07, height - 0.07, 0.003, material)


def mirror(scene, x, y, z, yaw, width, height):
    body = scene.body("mirror", x, y, z, yaw, item=True)
    body.box(0.012, 0, -height / 2, 0.02, width, height, "steel")
    body.panel(0.022, 0, 0, width - 0.05, height - 0.05, 0.003, "mirror")


def clock(scene, x, y, z, yaw):
    body = scene.body("clock", x, y, z, yaw, item=True)
    body.cylinder(0.016, 0, -0.015, 0.155, 0.03, "dark", (0, 90, 0))
    body.panel(0.0315, 0, 0, 0.2, 0.2, 0.002, "clock")
