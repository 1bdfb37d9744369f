# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Kitchen fronts and bathrooms.

A kitchen run starts at the origin and grows along +y, front towards +x, back at x = 0.
"""

from scene_xml import spot

TOP = 0.907  # of the worktop


class KitchenRun:
    """Units side by side along a wall: each call adds one, from left to right as one looks at the
    front."""

    def __init__(self, scene, x, y, yaw, front="front"):
        self.scene, self.x, self.y, self.yaw, self.front, self.at = scene, x, y, yaw, front, 0.0

    def body(self, kind, z=0.0, along=0.0, out=0.0, turn=0.0, item=False):
        return self.scene.body(
            kind, *spot(self.x, self.y, self.yaw, out, self.at + along), z, self.yaw + turn, item
        )

    def skip(self, width):
        self.at += width

    def carcass(self, body, width, high):
        body.box(0.3, 0, 0.1, 0.56, width - 0.002, high - 0.1, "carcass").box(
            0.27, 0, 0, 0.5, width - 0.002, 0.1, "plinth"
        )

    def cabinet(self, width, drawers=0):
        body = self.body("cabinet", along=width / 2)
        self.carcass(body, width, 0.87)
        if drawers:
            each = 0.76 / drawers
            for i in range(drawers):
                self.face(body, 0, 0.105 + i * each, width, each, False)
        else:
            count = 2 if width > 0.62 else 1
            for i in range(count):
                self.face(
                    body, width / count * (i - (count - 1) / 2), 0.105, width / count, 0.76, True
                )
        self.worktop(width)
        self.at += width

    def face(self, body, y, z, width, high, upright):
        body.box(0.589, y, z, 0.018, width - 0.006, high - 0.006, self.front)
        if upright:
            body.bar(
                (0.618, y + width / 2 - 0.05, z + high - 0.26),
                (0.618, y + width / 2 - 0.05, z + high - 0.08),
                0.007,
                "steel",
            )
        else:
            body.bar(
                (0.618, y - 0.09, z + high - 0.05),
                (0.618, y + 0.09, z + high - 0.05),
                0.007,
                "steel",
            )

    def worktop(self, width):
        self.body("counter", along=width / 2).box(
            0.31, 0, 0.871, 0.62, width, TOP - 0.871, "granite"
        )

    def oven(self, hob=True):
        """An oven under the worktop, 60 cm, and the hob above."""
        width = 0.6
        body = self.body("oven", along=width / 2)
        body.box(0.3, 0, 0.1, 0.56, width - 0.004, 0.768, "dark").box(
            0.27, 0, 0, 0.5, width - 0.002, 0.1, "plinth"
        )
        oven_front(body, 0.58, 0.265, 0.6)
        body.box(0.589, 0, 0.105, 0.018, width - 0.008, 0.15, self.front)
        self.worktop(width)
        if hob:
            cooker = self.body("hob", TOP, along=width / 2, item=True)
            cooker.box(0.31, 0, 0.0005, 0.5, 0.56, 0.007, "black")
            for sx, sy, r in (
                (0.2, 0.14, 0.09),
                (0.2, -0.14, 0.075),
                (0.42, 0.14, 0.075),
                (0.42, -0.14, 0.1),
            ):
                cooker.cylinder(sx, sy, 0.0075, r, 0.0018, "dark")
        self.at += width

    def tall_oven(self):
        """A tall unit with an oven at the height of the breast."""
        body = self.body("cabinet", along=0.31)
        body.box(0.29, 0, 0.1, 0.56, 0.618, 0.64, "carcass").box(
            0.27, 0, 0, 0.5, 0.6, 0.1, "plinth"
        ).box(0.29, 0, 1.37, 0.56, 0.618, 0.77, "carcass")
        self.face(body, 0, 0.105, 0.618, 0.31, False)
        self.face(body, 0, 0.415, 0.618, 0.32, False)
        self.face(body, 0, 1.375, 0.618, 0.76, True)
        oven = self.body("oven", along=0.31)
        oven.box(0.3, 0, 0.7415, 0.55, 0.61, 0.627, "dark")
        oven_front(oven, 0.574, 0.745, 0.62)
        self.at += 0.62

    def sink(self, width=0.8):
        """The worktop has a hole, the basin hangs in it, the tap stands behind."""
        body = self.body("cabinet", along=width / 2)
        body.box(0.3, 0, 0.1, 0.56, width - 0.002, 0.56, "carcass").box(
            0.27, 0, 0, 0.5, width - 0.002, 0.1, "plinth"
        )
        for i in (-1, 1):
            self.face(body, i * width / 4, 0.105, width / 2, 0.76, True)
        top, low, high = self.body("counter", along=width / 2), 0.871, TOP - 0.871
        rest = (width - 0.516) / 2
        for side in (-1, 1):
            top.box(0.31, side * (width / 2 - rest / 2), low, 0.62, rest, high, "granite")
        top.box(0.055, 0, low, 0.11, 0.516, high, "granite").box(
            0.57, 0, low, 0.1, 0.516, high, "granite"
        )
        self.body("sink", TOP + 0.0035, along=width / 2).mesh("kitchen_sink", 0.315, 0, 0, "steel")
        self.body("tap", TOP, along=width / 2).mesh("tap", 0.065, 0, 0, "steel")
        self.at += width

    def fridge(self, width=0.62, height=1.86):
        body = self.body("fridge", along=width / 2)
        body.box(0.31, 0, 0.05, 0.58, width - 0.004, height - 0.05, "fridge").box(
            0.29, 0, 0, 0.5, width - 0.04, 0.05, "dark"
        )
        body.box(0.628, 0, 0.06, 0.05, width - 0.006, 0.62, "fridge").box(
            0.628, 0, 0.69, 0.05, width - 0.006, height - 0.69, "fridge"
        )
        for low, high in ((0.36, 0.64), (0.74, 1.2)):
            body.bar(
                (0.685, width / 2 - 0.06, low), (0.685, width / 2 - 0.06, high), 0.011, "steel"
            )
        self.at += width

    def wall_cabinets(self, start, widths, bottom=1.44, height=0.7):
        """Hung cupboards from `start` along the run."""
        at = start
        for width in widths:
            body = self.body("cabinet", bottom, along=at + width / 2 - self.at)
            body.box(0.165, 0, 0, 0.33, width - 0.002, height, "carcass").box(
                0.339, 0, -0.01, 0.018, width - 0.006, height + 0.01, self.front
            )
            body.bar(
                (0.366, width / 2 - 0.05, 0.04), (0.366, width / 2 - 0.05, 0.2), 0.007, "steel"
            )
            at += width

    def hood(self, start, width=0.6, bottom=1.5):
        body = self.body("hood", bottom, along=start + width / 2 - self.at)
        body.box(0.25, 0, 0, 0.5, width - 0.01, 0.06, "steel").box(
            0.17, 0, 0.06, 0.3, 0.28, 2.5 - bottom - 0.06, "steel"
        )
        body.box(0.5, 0, 0.015, 0.006, 0.2, 0.03, "black")

    def splash(self, start, end, bottom=TOP, top=1.44, material="tiles_blue"):
        """Tiles on the wall: class wall."""
        body = self.body("wall", along=(start + end) / 2 - self.at)
        body.panel(0, 0, (bottom + top) / 2, end - start, top - bottom, 0.007, material)


def oven_front(body, x, z, width):
    """A door with a window, a bar, a strip with knobs and a clock.

    Z: its lower edge, 60 cm high.
    """
    body.box(x + 0.012, 0, z, 0.024, width - 0.01, 0.468, "steel").box(
        x + 0.0255, 0, z + 0.07, 0.003, width - 0.14, 0.28, "black"
    )
    body.box(x + 0.012, 0, z + 0.473, 0.024, width - 0.01, 0.125, "dark").box(
        x + 0.0255, 0, z + 0.505, 0.003, 0.15, 0.06, "screen"
    )
    for side in (-1, 1):
        body.bar(
            (x + 0.024, side * 0.22, z + 0.42), (x + 0.06, side * 0.22, z + 0.42), 0.008, "steel"
        )
        for at in (0.14, 0.22):
            body.bar(
                (x + 0.024, side * at, z + 0.536),
                (x + 0.048, side * at, z + 0.536),
                0.02,
                "steel",
                "cylinder",
            )
    body.bar((x + 0.06, -0.24, z + 0.42), (x + 0.06, 0.24, z + 0.42), 0.011, "steel")


def toilet(scene, x, y, yaw):
    """The wall is at the origin."""
    body = scene.body("toilet", x, y, 0, yaw)
    body.mesh("toilet", 0, 0, 0, "porcelain").box(0.095, 0, 0.4, 0.17, 0.38, 0.36, "porcelain").box(
        0.095, 0, 0.76, 0.19, 0.4, 0.03, "porcelain"
    )
    body.box(0.13, 0, 0.0, 0.24, 0.2, 0.4, "porcelain").cylinder(
        0.095, 0, 0.79, 0.022, 0.008, "steel"
    )


def washstand(scene, x, y, yaw):
    """A cabinet, the basin on it, a tap."""
    body = scene.body("cabinet", x, y, 0, yaw)
    body.box(0.235, 0, 0.2, 0.45, 0.62, 0.5, "birch").box(0.235, 0, 0.7, 0.48, 0.65, 0.03, "birch")
    for side in (-1, 1):
        body.box(0.466, side * 0.155, 0.215, 0.016, 0.3, 0.47, "front").ball(
            0.488, side * 0.03, 0.45, 0.013, "steel"
        )
        body.box(0.42, side * 0.28, 0, 0.04, 0.04, 0.2, "dark").box(
            0.05, side * 0.28, 0, 0.04, 0.04, 0.2, "dark"
        )
    scene.body("sink", *spot(x, y, yaw, 0.265, 0), 0.876, yaw).mesh(
        "wash_basin", 0, 0, 0, "porcelain"
    )
    scene.body("tap", *spot(x, y, yaw, 0.038, 0), 0.7305, yaw).mesh("tap", 0, 0, 0, "steel")


def bath(scene, x, y, yaw):
    """Along y, its back at the wall (origin); 0.76 x 1.7 m."""
    body = scene.body("bath", x, y, 0, yaw)
    body.mesh("bath", 0.37, 0, 0.571, "porcelain").box(0.714, 0, 0, 0.02, 1.628, 0.553, "porcelain")
    for side in (-1, 1):
        body.box(0.365, side * 0.81, 0, 0.67, 0.02, 0.553, "porcelain")
    scene.body("tap", *spot(x, y, yaw, 0.37, 0.795), 0.572, yaw - 90).mesh(
        "tap_low", 0, 0, 0, "steel"
    )


def washing_machine(scene, x, y, yaw):
    body = scene.body("washing_machine", x, y, 0, yaw)
    body.box(0.3, 0, 0.02, 0.56, 0.596, 0.83, "white").box(0.29, 0, 0, 0.5, 0.56, 0.02, "dark").box(
        0.583, 0, 0.72, 0.006, 0.56, 0.115, "carcass"
    )
    body.bar((0.58, 0, 0.4), (0.592, 0, 0.4), 0.2, "steel", "cylinder").bar(
        (0.592, 0, 0.4), (0.602, 0, 0.4), 0.15, "black", "cylinder"
    )
    body.bar((0.586, -0.2, 0.778), (0.606, -0.2, 0.778), 0.03, "steel", "cylinder").box(
        0.588, 0.12, 0.75, 0.004, 0.2, 0.05, "screen"
    )


def towel(scene, x, y, z, yaw, material="towel_red", width=0.46, height=0.72):
    """Over a rail on the wall; z: the rail."""
    body = scene.body("towel", x, y, z, yaw, item=True)
    body.bar((0.07, -width / 2 - 0.06, 0), (0.07, width / 2 + 0.06, 0), 0.009, "steel")
    for side in (-1, 1):
        body.bar(
            (0, side * (width / 2 + 0.05), 0), (0.07, side * (width / 2 + 0.05), 0), 0.008, "steel"
        )
    body.panel(0.0805, 0, -height / 2 + 0.012, width, height, 0.009, material).panel(
        0.05, 0, -0.2, width, 0.42, 0.009, material
    )
    body.box(0.07, 0, 0.0095, 0.039, width, 0.008, material)
