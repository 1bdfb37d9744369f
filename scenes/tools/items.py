# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What stands on tables, worktops and shelves; z: the top of what it stands on."""

import math

from scene_xml import spot

BOOKS = ["book_red", "book_blue", "book_green", "book_sand", "book_black", "book_orange"]


def cup(scene, x, y, z, yaw=0, glaze="cobalt", low=False):
    scene.body("cup", x, y, z, yaw, item=True).mesh("mug_low" if low else "mug", 0, 0, 0, glaze)


def wine(scene, x, y, z):
    body = scene.body("bottle", x, y, z, item=True)
    body.mesh("wine_bottle", 0, 0, 0, "wine_glass").cylinder(
        0, 0, 0.075, 0.0381, 0.08, "label"
    ).cylinder(0, 0, 0.262, 0.0172, 0.0425, "cherry")


def water(scene, x, y, z, liquid="water_glass"):
    body = scene.body("bottle", x, y, z, item=True)
    body.mesh("water_bottle", 0, 0, 0, liquid).cylinder(
        0, 0, 0.12, 0.0416, 0.055, "label"
    ).cylinder(0, 0, 0.256, 0.0181, 0.019, "cobalt")


def soap(scene, x, y, z, yaw=0, glaze="mint"):
    scene.body("bottle", x, y, z, yaw, item=True).mesh("soap_bottle", 0, 0, 0, glaze)


def plate(scene, x, y, z):
    scene.body("plate", x, y, z, item=True).mesh("plate", 0, 0, 0, "porcelain")


def fruit_bowl(scene, x, y, z):
    body = scene.body("bowl", x, y, z, item=True).mesh("bowl", 0, 0, 0, "cobalt")
    for dx, dy, dz, r, kind in (
        (0.045, 0.02, 0.055, 0.04, "orange"),
        (-0.04, 0.035, 0.055, 0.041, "apple"),
        (0.0, -0.05, 0.055, 0.04, "orange"),
        (0.0, 0.0, 0.105, 0.039, "cherry"),
    ):
        body.ball(dx, dy, dz, r, kind)


def bowl(scene, x, y, z, glaze="mint"):
    scene.body("bowl", x, y, z, item=True).mesh("bowl_small", 0, 0, 0, glaze)


def vase(scene, x, y, z, glaze="mint"):
    body = scene.body("vase", x, y, z, item=True)
    body.mesh("vase", 0, 0, 0, glaze).mesh("tulip_stems", 0, 0, 0.02, "leaf").mesh(
        "tulip_heads", 0, 0, 0.02, "tulip"
    )


def small_plant(scene, x, y, z, pot="terracotta", yaw=0):
    body = scene.body("plant", x, y, z, yaw, item=True)
    body.mesh("flower_pot_small", 0, 0, 0, pot).cylinder(0, 0, 0.09, 0.056, 0.015, "soil").mesh(
        "sword_plant", 0, 0, 0.1, "leaf_dark"
    )


def table_lamp(scene, x, y, z, foot="teal_shell"):
    body = scene.body("lamp", x, y, z, item=True)
    body.mesh("lamp_foot", 0, 0, 0, foot).mesh("shade_table", 0, 0, 0.235, "glow").ball(
        0, 0, 0.31, 0.028, "bulb"
    )


def pendant(scene, x, y, bottom, ceiling=2.507):
    body = scene.body("lamp", x, y, bottom, item=True)
    body.mesh("shade_pendant", 0, 0, 0, "glow").ball(0, 0, 0.07, 0.04, "bulb").cylinder(
        0, 0, 0.17, 0.006, ceiling - bottom - 0.171, "dark"
    )
    body.cylinder(0, 0, ceiling - bottom - 0.026, 0.05, 0.025, "dark")


def ceiling_lamp(scene, x, y, ceiling=2.507):
    scene.body("lamp", x, y, ceiling, item=True).cylinder(
        0, 0, -0.081, 0.17, 0.065, "glow"
    ).cylinder(0, 0, -0.016, 0.18, 0.0155, "steel")


def books(scene, x, y, z, yaw, count, seed=0, deep=0.19):
    """A row of upright books along +y from the origin (its left end), backs towards +x.

    One object.
    """
    body, at = scene.body("book", x, y, z, yaw, item=True), 0.0
    for i in range(count):
        k = (seed * 7 + i * 5) % 11
        thick, high, back = (
            0.022 + 0.004 * (k % 6),
            0.19 + 0.011 * ((k * 3) % 8),
            deep - 0.006 * (k % 4),
        )
        body.box(
            0.04 + back / 2,
            at + thick / 2,
            0,
            back,
            thick - 0.001,
            high,
            BOOKS[(seed + i * 5 + k) % len(BOOKS)],
        )
        at += thick
    return at


def fill_shelf(scene, x, y, yaw, tops, width, counts=(12, 9, 13, 8, 10)):
    """Rows of books on the boards of a shelf, other things at their right ends."""
    left, right = -width / 2 + 0.04, width / 2
    for i, (top, count) in enumerate(zip(tops, counts)):
        books(scene, *spot(x, y, yaw, 0, left), top, yaw, count, i)
    carton = scene.body("box", *spot(x, y, yaw, 0.15, right - 0.2), tops[0], yaw, item=True)
    carton.box(0, 0, 0, 0.22, 0.3, 0.2, "cardboard").box(0, 0, 0.2, 0.228, 0.308, 0.02, "cardboard")
    books(scene, *spot(x, y, yaw, 0, right - 0.24), tops[1], yaw, 5, 5)
    cup(scene, *spot(x, y, yaw, 0.15, right - 0.12), tops[2], yaw - 100, "cherry")
    bowl(scene, *spot(x, y, yaw, 0.16, right - 0.2), tops[3], "sun")
    if len(tops) > 4:
        wine(scene, *spot(x, y, yaw, 0.15, right - 0.16), tops[4])


def book_pile(scene, x, y, z, yaw, count=3, seed=0):
    body, top = scene.body("book", x, y, z, yaw, item=True), 0.0
    for i in range(count):
        thick = 0.02 + 0.007 * ((seed + i * 2) % 3)
        body.box(
            0,
            0,
            top,
            0.15 - 0.008 * i,
            0.21 - 0.012 * i,
            thick,
            BOOKS[(seed + i * 2) % len(BOOKS)],
            (0, 0, 9 * ((seed + i) % 3 - 1)),
        )
        top += thick


def cushion(scene, x, y, z, yaw, cloth="ochre_cloth", lean=62):
    """Leans on a back that is behind it (-x)."""
    scene.body("cushion", x, y, z, yaw, item=True).mesh(
        "cushion", 0, 0, 0, cloth, euler=(0, lean, 0)
    )


def laptop(scene, x, y, z, yaw):
    """The keyboard's front edge towards +x."""
    body = scene.body("laptop", x, y, z, yaw, item=True)
    body.box(0, 0, 0, 0.23, 0.33, 0.017, "steel").box(0.02, 0, 0.017, 0.12, 0.29, 0.0015, "dark")
    tilt = 17
    body.box(-0.147, 0, 0.012, 0.008, 0.33, 0.222, "steel", (0, -tilt, 0))
    s, c = math.sin(math.radians(tilt)), math.cos(math.radians(tilt))
    body.geom(
        'type="box"',
        (-0.147 + 0.0045 * c, 0, 0.123 + 0.0045 * s),
        (0.155, 0.1, 0.001),
        "desktop",
        f' xyaxes="0 1 0 {-s:.4f} 0 {c:.4f}"',
    )


def monitor(scene, x, y, z, yaw, width=0.6):
    """A desk's screen: class tv."""
    body = scene.body("tv", x, y, z, yaw, item=True)
    body.box(0, 0, 0, 0.19, 0.24, 0.012, "dark").box(
        -0.025, 0, 0.012, 0.025, 0.06, 0.2, "dark"
    ).box(0, 0, 0.105, 0.028, width, 0.36, "black")
    body.panel(0.014, 0, 0.287, width - 0.022, 0.33, 0.0025, "desktop")


def kettle(scene, x, y, z, yaw, glaze="cherry"):
    scene.body("kettle", x, y, z, yaw, item=True).mesh("kettle", 0, 0, 0, glaze)


def pot(scene, x, y, z, yaw=0, metal="steel"):
    scene.body("pot", x, y, z, yaw, item=True).mesh("pot", 0, 0, 0, metal)


def pan(scene, x, y, z, yaw=0):
    scene.body("pot", x, y, z, yaw, item=True).mesh("pan", 0, 0, 0, "dark")
