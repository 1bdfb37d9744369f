# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What stands on the floor.

Front towards +x at yaw 0; the origin lies on the floor, in the middle or, where told, at the
wall.
"""

import math

from scene_xml import spot


def dining_chair(scene, x, y, yaw, wood="oak"):
    body = scene.body("chair", x, y, 0, yaw)
    for side in (-1, 1):
        body.box(0.188, side * 0.186, 0, 0.038, 0.038, 0.43, wood)
        body.box(-0.188, side * 0.186, 0, 0.036, 0.036, 0.9, wood)
        body.box(0, side * 0.186, 0.2, 0.34, 0.02, 0.028, wood)
    body.box(0, 0, 0.43, 0.425, 0.42, 0.03, wood)
    body.box(0.012, 0, 0.46, 0.38, 0.38, 0.022, "seat_cloth")
    for z in (0.56, 0.68, 0.8):
        body.mesh("chair_rail", -0.215, 0, z - 0.01, wood)


def shell_chair(scene, x, y, yaw, shell="teal_shell"):
    body = scene.body("chair", x, y, 0, yaw)
    body.mesh("shell_chair", 0, 0, 0.455, shell)
    for sx in (-1, 1):
        for sy in (-1, 1):
            body.bar(
                (sx * 0.09 - 0.02, sy * 0.1, 0.44), (sx * 0.2 - 0.02, sy * 0.2, 0.012), 0.012, "oak"
            )
    body.bar((-0.11, -0.1, 0.43), (0.07, 0.1, 0.43), 0.008, "dark")
    body.bar((-0.11, 0.1, 0.43), (0.07, -0.1, 0.43), 0.008, "dark")


def office_chair(scene, x, y, yaw, cloth="black_cloth"):
    body = scene.body("chair", x, y, 0, yaw)
    for k in range(5):
        a = math.radians(72 * k + 18)
        c, s = math.cos(a), math.sin(a)
        body.bar((0.03 * c, 0.03 * s, 0.105), (0.27 * c, 0.27 * s, 0.075), 0.019, "dark")
        body.ball(0.275 * c, 0.275 * s, 0.031, 0.03, "black")
    body.cylinder(0, 0, 0.09, 0.027, 0.35, "steel")
    body.box(0, 0, 0.43, 0.2, 0.2, 0.03, "dark")
    body.mesh("chair_seat", 0.015, 0, 0.455, cloth)
    body.mesh("chair_back", -0.235, 0, 0.6, cloth)
    body.bar((-0.06, 0, 0.445), (-0.27, 0, 0.47), 0.02, "dark").bar(
        (-0.27, 0, 0.47), (-0.275, 0, 0.72), 0.02, "dark"
    )
    for side in (-1, 1):
        body.bar((-0.02, side * 0.2, 0.47), (-0.02, side * 0.275, 0.49), 0.013, "dark")
        body.bar((-0.02, side * 0.275, 0.49), (-0.02, side * 0.275, 0.67), 0.013, "dark")
        body.box(0.01, side * 0.275, 0.675, 0.24, 0.06, 0.027, "black")


def bar_stool(scene, x, y, yaw, cloth="red_cloth"):
    body = scene.body("chair", x, y, 0, yaw)
    body.cylinder(0, 0, 0, 0.21, 0.018, "steel").cylinder(0, 0, 0.018, 0.025, 0.6, "steel")
    body.cylinder(0, 0, 0.618, 0.18, 0.06, cloth).mesh("chair_rail", -0.2, 0, 0.76, cloth)
    for side in (-1, 1):
        body.bar((-0.14, side * 0.08, 0.64), (-0.2, side * 0.08, 0.8), 0.01, "steel")
    body.bar((0.14, -0.1, 0.28), (0.14, 0.1, 0.28), 0.011, "steel").bar(
        (0, 0, 0.28), (0.14, 0, 0.28), 0.011, "steel"
    )


def table(scene, x, y, yaw, length, width, height, wood="oak", leg=0.06):
    """Length along x. Returns the height of its top."""
    body = scene.body("table", x, y, 0, yaw)
    body.box(0, 0, height - 0.034, length, width, 0.034, wood)
    body.box(0, 0, height - 0.11, length - 0.16, width - 0.16, 0.076, wood)
    for sx in (-1, 1):
        for sy in (-1, 1):
            body.box(
                sx * (length / 2 - 0.05), sy * (width / 2 - 0.05), 0, leg, leg, height - 0.034, wood
            )
    return height


def round_table(scene, x, y, radius, height, wood="walnut"):
    body = scene.body("table", x, y, 0)
    body.cylinder(0, 0, height - 0.028, radius, 0.028, wood).cylinder(
        0, 0, 0.021, 0.035, height - 0.049, "dark"
    )
    body.cylinder(0, 0, 0, 0.6 * radius, 0.021, "dark")
    return height


def coffee_table(scene, x, y, yaw, length=1.1, width=0.6, wood="walnut"):
    body = scene.body("table", x, y, 0, yaw)
    body.box(0, 0, 0.387, length, width, 0.032, wood).box(
        0, 0, 0.14, length - 0.12, width - 0.1, 0.02, wood
    )
    for sx in (-1, 1):
        for sy in (-1, 1):
            body.box(
                sx * (length / 2 - 0.04), sy * (width / 2 - 0.04), 0, 0.045, 0.045, 0.387, wood
            )
    return 0.419


def desk(scene, x, y, yaw, length=1.4, wood="birch"):
    """Along y, its back at the wall (origin), drawers at +y."""
    body = scene.body("table", x, y, 0, yaw)
    body.box(0.325, 0, 0.707, 0.65, length, 0.03, wood)
    body.box(0.31, -length / 2 + 0.035, 0, 0.56, 0.03, 0.707, wood)
    body.box(0.31, length / 2 - 0.22, 0.03, 0.54, 0.4, 0.677, wood)
    for z in (0.06, 0.28, 0.5):
        body.box(0.585, length / 2 - 0.22, z, 0.014, 0.38, 0.19, "front").box(
            0.6, length / 2 - 0.22, z + 0.14, 0.018, 0.12, 0.012, "steel"
        )
    return 0.737


def sofa(scene, x, y, yaw, seats=3, cloth="sofa_cloth", light="sofa_light"):
    """Origin in the middle of its floor space; the back towards -x."""
    width = 0.765 * seats
    body = scene.body("sofa", x, y, 0, yaw)
    body.box(0, 0, 0.09, 0.84, width + 0.34, 0.2, cloth).box(
        -0.35, 0, 0.29, 0.16, width + 0.34, 0.5, cloth
    )
    for i in range(seats):
        at = 0.765 * (i - (seats - 1) / 2)
        body.mesh("sofa_seat", 0.085, at, 0.365, light).mesh(
            "sofa_back", -0.2, at, 0.62, light, euler=(0, -11, 0)
        )
    for side in (-1, 1):
        body.mesh("sofa_arm", 0, side * (width / 2 + 0.1), 0.42, cloth)
        for sx in (-0.36, 0.36):
            body.cylinder(sx, side * (width / 2 + 0.08), 0, 0.025, 0.09, "dark")


def armchair(scene, x, y, yaw, cloth="moss_cloth"):
    """An upholstered chair: class sofa."""
    sofa(scene, x, y, yaw, 1, cloth, cloth)


def bed(scene, x, y, yaw, double=True, wood="oak"):
    """The head towards -x, at the origin; 2.05 m long. The duvet belongs to it."""
    width = 1.62 if double else 0.92
    body = scene.body("bed", x, y, 0, yaw)
    body.box(0.02, 0, 0, 0.045, width + 0.1, 0.98, wood).box(
        2.085, 0, 0.09, 0.035, width + 0.06, 0.3, wood
    )
    for side in (-1, 1):
        body.box(1.055, side * (width / 2 + 0.012), 0.12, 2.025, 0.028, 0.2, wood).box(
            2.07, side * (width / 2 - 0.03), 0, 0.06, 0.06, 0.09, "dark"
        )
    body.box(1.05, 0, 0.16, 2.0, width - 0.01, 0.14, wood)
    body.mesh(
        "mattress" if double else "mattress_single", 1.05, 0, 0.40 if double else 0.39, "linen"
    )
    body.mesh("duvet" if double else "duvet_single", 1.36, 0, 0.492 if double else 0.472, "checks")
    for side in (-0.42, 0.4) if double else (0.01,):
        scene.body(
            "pillow", *spot(x, y, yaw, 0.31, side), 0.555 if double else 0.535, yaw, item=True
        ).mesh("pillow", 0, 0, 0, "linen", euler=(0, -14, 0))


def wardrobe(scene, x, y, yaw, doors=3, height=2.13, wood="ashgrey"):
    """The back at the wall (origin), doors along y."""
    width = 0.5 * doors
    body = scene.body("wardrobe", x, y, 0, yaw)
    body.box(0.29, 0, 0.06, 0.58, width, height - 0.06, wood).box(
        0.28, 0, 0, 0.52, width - 0.04, 0.06, "plinth"
    )
    for i in range(doors):
        at = 0.5 * (i - (doors - 1) / 2)
        body.box(0.59, at, 0.075, 0.02, 0.492, height - 0.09, "front" if i != 1 else wood)
        edge = at + (0.2 if i % 2 == 0 else -0.2)
        body.bar((0.618, edge, 0.95), (0.618, edge, 1.2), 0.008, "steel")


def shelf(scene, x, y, yaw, width=0.9, boards=5, gap=0.36, wood="oak", deep=0.3):
    """Open shelf, the back at the wall (origin). Returns the heights of its boards."""
    height = 0.06 + boards * gap
    body = scene.body("shelf", x, y, 0, yaw)
    body.box(0.008, 0, 0.03, 0.012, width - 0.05, height - 0.04, wood)
    for side in (-1, 1):
        body.box(deep / 2, side * (width / 2 - 0.011), 0, deep, 0.022, height, wood)
    tops = []
    for i in range(boards + 1):
        z = 0.04 + i * gap - (0.004 if i == boards else 0)
        body.box(deep / 2 + 0.006, 0, z, deep - 0.02, width - 0.048, 0.022, wood)
        tops.append(z + 0.022)
    return tops[:-1]


def board(scene, x, y, yaw, width=1.7, wood="walnut"):
    """A low sideboard for a tv, the back at the wall. Returns its top."""
    body = scene.body("cabinet", x, y, 0, yaw)
    body.box(0.21, 0, 0.09, 0.4, width, 0.37, wood).box(
        0.2, 0, 0.46, 0.42, width + 0.03, 0.024, "oak"
    )
    for side in (-1, 1):
        for sx in (0.06, 0.36):
            body.cylinder(sx, side * (width / 2 - 0.08), 0, 0.02, 0.09, "dark")
    for i in range(3):
        body.box(
            0.418,
            width / 3 * (i - 1),
            0.11,
            0.016,
            width / 3 - 0.012,
            0.33,
            "oak" if i != 1 else wood,
        )
        body.ball(
            0.438,
            width / 3 * (i - 1) + (0.2 if i == 0 else -0.2 if i == 2 else 0),
            0.275,
            0.014,
            "steel",
        )
    return 0.484


def chest(scene, x, y, yaw, width=0.46, drawers=2, height=0.5, deep=0.4, wood="oak"):
    """Bedside cabinet or chest of drawers, the back at the wall. Returns its top."""
    body = scene.body("cabinet", x, y, 0, yaw)
    body.box(deep / 2, 0, 0.05, deep - 0.02, width, height - 0.074, wood).box(
        deep / 2, 0, height - 0.024, deep + 0.014, width + 0.02, 0.024, wood
    )
    body.box(deep / 2 - 0.01, 0, 0, deep - 0.06, width - 0.04, 0.05, "plinth")
    each = (height - 0.1) / drawers
    for i in range(drawers):
        body.box(deep - 0.004, 0, 0.065 + i * each, 0.016, width - 0.03, each - 0.015, "front")
        body.ball(deep + 0.016, 0, 0.065 + (i + 0.5) * each, 0.013, "steel")
    return height


def rug(scene, x, y, yaw, length, width, material="rug"):
    scene.body("rug", x, y, 0, yaw, item=True).box(0, 0, 0.0013, length, width, 0.0086, material)


def tv_on_stand(scene, x, y, z, yaw, width=1.24, picture="screen"):
    """On a board: origin where its foot stands; the screen looks to +x."""
    height = 0.575 * width
    body = scene.body("tv", x, y, z, yaw)
    body.box(0, 0, 0, 0.2, 0.44, 0.014, "black").box(-0.012, 0, 0.014, 0.03, 0.09, 0.09, "black")
    body.box(0, 0, 0.07, 0.035, width, height, "black")
    body.panel(0.0175, 0, 0.075 + height / 2, width - 0.026, height - 0.036, 0.003, picture)


def tv_on_wall(scene, x, y, z, yaw, width=0.96, picture="film"):
    """z: the middle of the screen."""
    height = 0.575 * width
    body = scene.body("tv", x, y, z, yaw)
    body.box(0.025, 0, -0.12, 0.046, 0.24, 0.24, "dark").box(
        0.066, 0, -height / 2, 0.038, width, height, "black"
    )
    body.panel(0.085, 0, 0.006, width - 0.026, height - 0.036, 0.003, picture)


def floor_lamp(scene, x, y):
    body = scene.body("lamp", x, y, 0)
    body.cylinder(0, 0, 0, 0.14, 0.024, "dark").cylinder(0, 0, 0.024, 0.012, 1.5, "steel")
    body.mesh("shade_floor", 0, 0, 1.38, "glow").ball(0, 0, 1.5, 0.04, "bulb")


def plant(scene, x, y, kind="ficus", pot="terracotta", yaw=0):
    body = scene.body("plant", x, y, 0, yaw)
    body.mesh("flower_pot", 0, 0, 0, pot).cylinder(0, 0, 0.255, 0.15, 0.02, "soil")
    body.mesh(kind, 0, 0, 0.272, "leaf" if kind == "ficus" else "leaf_dark", soft=True)


def bin(scene, x, y, radius=0.13, height=0.36):
    scene.body("bin", x, y, 0).cylinder(0, 0, 0, radius, height, "steel").cylinder(
        0, 0, height, radius + 0.008, 0.022, "dark"
    )


def basket(scene, x, y):
    body = scene.body("basket", x, y, 0)
    body.mesh("basket", 0, 0, 0, "wicker")


def box(scene, x, y, z, yaw, dx, dy, dz, material="cardboard"):
    scene.body("box", x, y, z, yaw, item=z > 0).box(0, 0, 0, dx, dy, dz, material).box(
        0, 0, dz, dx + 0.008, dy + 0.008, 0.02, material
    )
