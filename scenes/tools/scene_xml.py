# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes MJCF one object a block, and the class file beside it.

Lengths in metres, angles in degrees; sizes are whole ones.
"""

import math
import pathlib
import re

from materials import CLASSES, asset_lines
from solid import decimal

LICENCE = "SPDX-FileCopyrightText: 2026 the mapscore authors\n     SPDX-License-Identifier: MIT"


def odd_mm(value):
    """The odd millimetre at or next above: no surface shall lie on the voxel lattice."""
    return (2 * math.floor(round(value * 1000, 3) / 2) + 1) / 1000


def numbers(*values):
    return " ".join(decimal(v) for v in values)


def spot(x, y, yaw, out, along):
    """World x, y of what lies `out` (local x) and `along` (local y) from a thing at x, y, yaw."""
    a = math.radians(yaw)
    return x + out * math.cos(a) - along * math.sin(a), y + out * math.sin(a) + along * math.cos(a)


class Body:
    """One object.

    Local frame: front towards +x, z up, origin on what it stands on or hangs from.
    """

    def __init__(self, name, place, yaw, item):
        self.name, self.place, self.yaw, self.item, self.lines = name, place, yaw, item, []

    def geom(self, kind, pos, size, material, turn=""):
        look = material if "=" in material else f'material="{material}"'
        size = f' size="{numbers(*size)}"' if size else ""
        self.lines.append(f'<geom {kind} pos="{numbers(*pos)}"{size}{turn} {look}/>')
        return self

    def box(self, x, y, z, dx, dy, dz, material, euler=None):
        """x, y: the middle; z: the LOWER face."""
        turn = f' euler="{numbers(*euler)}"' if euler else ""
        return self.geom('type="box"', (x, y, z + dz / 2), (dx / 2, dy / 2, dz / 2), material, turn)

    def cylinder(self, x, y, z, radius, height, material, euler=None):
        turn = f' euler="{numbers(*euler)}"' if euler else ""
        return self.geom(
            'type="cylinder"', (x, y, z + height / 2), (radius, height / 2), material, turn
        )

    def bar(self, a, b, radius, material, kind="capsule"):
        self.lines.append(
            f'<geom type="{kind}" fromto="{numbers(*a, *b)}" size="{numbers(radius)}" '
            f'material="{material}"/>'
        )
        return self

    def ball(self, x, y, z, radius, material):
        return self.geom('type="sphere"', (x, y, z), (radius,), material)

    def mesh(self, mesh, x, y, z, material, euler=None, soft=False):
        """soft: gives way to a robot, as leaves do."""
        turn = f' euler="{numbers(*euler)}"' if euler else ""
        kind = 'class="item" type="mesh"' if soft else 'type="mesh"'
        return self.geom(f'{kind} mesh="{mesh}"', (x, y, z), None, material, turn)

    def panel(self, x, y, z, width, height, thick, material, facing="+x"):
        """An upright plate whose picture is seen from `facing`.

        Z: the middle; (x, y): the middle of its BACK.
        """
        right, out = {
            "+x": ((0, 1, 0), (1, 0)),
            "-x": ((0, -1, 0), (-1, 0)),
            "+y": ((-1, 0, 0), (0, 1)),
            "-y": ((1, 0, 0), (0, -1)),
        }[facing]
        pos = (x + out[0] * thick / 2, y + out[1] * thick / 2, z)
        return self.geom(
            'type="box"',
            pos,
            (width / 2, height / 2, thick / 2),
            material,
            f' xyaxes="{numbers(*right, 0, 0, 1)}"',
        )

    def block(self):
        turn = f' euler="0 0 {decimal(self.yaw)}"' if self.yaw else ""
        place = f' pos="{numbers(*self.place)}"' if any(self.place) or turn else ""
        kind = ' childclass="item"' if self.item else ""
        return (
            [f'    <body name="{self.name}"{place}{turn}{kind}>']
            + [f"      {line}" for line in self.lines]
            + ["    </body>"]
        )


class Scene:
    """Bodies in the order they are added, named class_1, class_2, ..."""

    def __init__(self, model, about, centre, extent):
        self.model, self.about, self.centre, self.extent = model, about, centre, extent
        self.parts, self.count, self.lights = [], {}, []

    def section(self, text):
        self.parts += ["", f"    <!-- {text} -->"]

    def lamp_light(self, name, x, y, z, colour, shadow, cutoff, exponent):
        """Light of a lamp at x, y, z, downwards."""
        self.lights.append(
            f'    <light name="{name}" pos="{numbers(x, y, z)}" dir="0.01 0.02 -1" '
            f'cutoff="{cutoff}" exponent="{exponent}" castshadow="{str(shadow).lower()}" '
            f'ambient="0.04 0.04 0.04" diffuse="{numbers(*colour)}" specular="0.2 0.2 0.2" '
            'attenuation="1 0.02 0.01"/>'
        )

    def even_light(self, name, direction, colour):
        """Light from one side in all rooms, without shadows: day, and what walls throw back."""
        self.lights.append(
            f'    <light name="{name}" directional="true" pos="4 4 1" dir="{numbers(*direction)}" '
            f'castshadow="false" diffuse="{numbers(*colour)}" specular="0 0 0"/>'
        )

    def body(self, kind, x=0.0, y=0.0, z=0.0, yaw=0.0, item=False, fixed=False):
        """A new object of a class.

        x and y go to odd millimetres unless `fixed` (the shell, whose geoms bear the
        coordinates).
        """
        assert kind in CLASSES, kind
        self.count[kind] = self.count.get(kind, 0) + 1
        place = (x, y, z) if fixed else (odd_mm(x), odd_mm(y), z)
        body = Body(f"{kind}_{self.count[kind]}", place, yaw, item)
        self.parts.append(body)
        return body

    def mjcf(self):
        lines = [
            f"<!-- {LICENCE}\n\n     {self.about} -->",
            f'<mujoco model="{self.model}">',
            HEAD.format(
                extent=numbers(self.extent),
                centre=numbers(*self.centre),
                znear=numbers(0.1 / self.extent),
                zfar=numbers(20 / self.extent),
            ),
        ]
        objects = []
        for part in self.parts:
            objects += [part] if isinstance(part, str) else part.block()
        used = set(re.findall(r'"([^"]*)"', "".join(objects)))
        lines += asset_lines(used) + ["  <worldbody>"] + self.lights + objects
        return "\n".join(lines + ["  </worldbody>", "</mujoco>"]) + "\n"

    def classes(self):
        lines = [
            "# Classes of home.xml and cottage.xml, ids from 1 in this order; 0 is background.",
            "classes:",
        ]
        for name, (colour, detect) in CLASSES.items():
            lines.append(
                f'  - {{name: {name}, colour: "{colour}", detect: {str(detect).lower()}, '
                f'bodies: ["{name}_*"]}}'
            )
        return "\n".join(lines) + "\n"

    def write(self, folder):
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{self.model}.xml").write_text(self.mjcf())
        (folder / f"{self.model}.classes.yaml").write_text(self.classes())


HEAD = """  <compiler angle="degree" meshdir="meshes" texturedir="textures"/>
  <!-- near plane 0.1 m, far plane 20 m -->
  <statistic extent="{extent}" center="{centre}"/>
  <visual>
    <global offwidth="1280" offheight="960"/>
    <map znear="{znear}" zfar="{zfar}" shadowclip="0.7" shadowscale="0.9"/>
    <quality shadowsize="2048"/>
    <headlight ambient="0.43 0.43 0.44" diffuse="0.12 0.12 0.12" specular="0 0 0"/>
  </visual>

  <default>
    <default class="item">
      <!-- seen, but nothing that a robot runs into -->
      <geom contype="0" conaffinity="0"/>
    </default>
  </default>
"""
