# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Varies a home: colours, textures, lamps and the places of things, all from one seed.

Domain randomisation (Tobin et al., 2017): a network that has seen a hundred homes of other colours and
other arrangements takes the next home for one more of them.
"""

import colorsys
import math
import pathlib
import xml.etree.ElementTree as xml

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"

SURFACES = ["grain", "weave", "stone", "carpet", "planks", "tiles_wall", "tiles_floor", "stripes", "checks"]
PICTURES = ["landscape", "film", "abstract", "portrait", "desktop"]
CUBES = {"grain", "stone", "spine"}
# Things whose place is the middle of their foot: any of them may stand where another stood.
ON_TABLES = {"cup", "bottle", "vase", "bowl", "kettle", "pot"}
ON_FLOORS = {"plant", "bin", "basket", "box", "lamp"}
FURNITURE = {"table", "sofa", "bed", "cabinet", "shelf", "wardrobe", "chair"}
# Metres and degrees that a thing moves at most: along its front, out of it, and about its vertical axis.
REACH = {"chair": (0.2, 0.2, 45), "rug": (0.3, 0.3, 20), "sofa": (0.25, 0.15, 8), "table": (0.2, 0.12, 8),
         "bed": (0.15, 0.08, 3), "cabinet": (0.08, 0.02, 0), "shelf": (0.15, 0.02, 0), "lamp": (0.1, 0.1, 180),
         "wardrobe": (0.15, 0.02, 0), "plant": (0.1, 0.1, 180), "bin": (0.2, 0.2, 180),
         "basket": (0.2, 0.2, 180), "box": (0.05, 0.05, 40), "laptop": (0.03, 0.03, 25),
         "cup": (0.05, 0.05, 180), "bottle": (0.05, 0.05, 180), "vase": (0.03, 0.03, 180),
         "bowl": (0.04, 0.04, 180), "plate": (0.02, 0.02, 180), "kettle": (0.03, 0.03, 180)}
# Classes whose colour is part of what they are: only tinted.
KEEPS_COLOUR = {"plant", "sky", "tv", "picture", "ceiling", "hob", "oven", "toilet", "bath", "sink"}


def numbers(text):
    return [float(v) for v in text.split()]


def text_of(values):
    return " ".join(f"{v:.4f}" for v in values)


def kind_of(body):
    return body.get("name").rsplit("_", 1)[0]


class Variation:
    """One home, varied. `tree`: its MJCF, changed in place by the methods, which draw from `random`.

    Homes of odd seeds keep most of their own colours and textures, those of even seeds few.
    """

    def __init__(self, scene, seed):
        self.tree = xml.parse(scene).getroot()
        self.repainted, self.retextured = (0.4, 0.35) if seed % 2 == 0 else (0.1, 0.08)
        self.random = np.random.default_rng(seed)
        self.bodies = [b for b in self.tree.find("worldbody") if b.tag == "body"]

    def chance(self, p):
        return self.random.random() < p

    # Looks

    def colour(self):
        """A paint: any hue, seldom garish, rather bright."""
        hue, grey, value = self.random.random(), self.random.beta(1.2, 2.4), self.random.beta(1.8, 1.1)
        return np.array(colorsys.hsv_to_rgb(hue, grey, value))

    def tinted(self, rgb, amount):
        return np.clip(rgb * self.random.uniform(1 - amount, 1 + amount)
                       + self.random.uniform(-amount / 3, amount / 3, 3), 0.02, 1)

    def add_textures(self):
        """The textures of the homes, for scenes that have only MuJoCo's own."""
        asset = self.tree.find("asset")
        known = {t.get("name") for t in asset.findall("texture")}
        for name in SURFACES + PICTURES:
            if "file_" + name not in known:
                xml.SubElement(asset, "texture", name="file_" + name, file=f"{SCENES}/textures/{name}.png",
                               type="cube" if name in CUBES else "2d")

    def dress_materials(self):
        """Other textures and scales; pictures change places with pictures."""
        for material in self.tree.find("asset").findall("material"):
            texture = material.get("texture", "")
            if texture in PICTURES:
                material.set("texture", "file_" + str(self.random.choice(PICTURES)))
            elif texture not in ("garden", "sky", "clock", "screen", "spine") and self.chance(self.retextured):
                material.set("texture", "file_" + str(self.random.choice(SURFACES)))
                if "texuniform" not in material.attrib and not texture:
                    material.set("texuniform", "true")
                    material.set("texrepeat", "3 3")
            if "texrepeat" in material.attrib:
                repeat = np.array(numbers(material.get("texrepeat"))) * self.random.uniform(0.6, 1.7)
                material.set("texrepeat", text_of(repeat))

    def paint_bodies(self):
        """Each look within a body stays, is tinted, or gets any colour; bodies differ from each other."""
        base = {m.get("name"): np.array(numbers(m.get("rgba", "1 1 1 1"))[:3])
                for m in self.tree.find("asset").findall("material")}
        for body in self.bodies:
            free = kind_of(body) not in KEEPS_COLOUR
            repaint, painted = self.random.random(), {}
            for geom in body.iter("geom"):
                look = (geom.get("material"), geom.get("rgba"))
                if look not in painted:
                    rgb = np.array(numbers(look[1])[:3]) if look[1] else base.get(look[0], np.full(3, 0.5))
                    painted[look] = (self.colour() if free and repaint < self.repainted
                                     else self.tinted(rgb, 0.25 if repaint < 0.8 else 0.08))
                geom.set("rgba", text_of([*painted[look], 1]))

    def light(self):
        """Lamps move, day comes from elsewhere, all of another strength and warmth."""
        warmth = self.random.uniform(-0.08, 0.08) * np.array([1, 0, -1])
        strength = self.random.uniform(0.8, 1.35)
        for light in self.tree.find("worldbody").findall("light"):
            own = self.random.uniform(0.6, 1.4) * strength
            light.set("diffuse", text_of(np.clip((np.array(numbers(light.get("diffuse"))) + warmth) * own, 0, 1)))
            direction = np.array(numbers(light.get("dir")))
            if light.get("directional") == "true":
                turn = self.random.uniform(0, 2 * math.pi)
                c, s = math.cos(turn), math.sin(turn)
                direction[:2] = [c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]]
            else:
                place = np.array(numbers(light.get("pos")))
                place[:2] += self.random.uniform(-0.8, 0.8, 2)
                light.set("pos", text_of(place))
            light.set("dir", text_of(direction + self.random.uniform(-0.15, 0.15, 3)))
        head = self.tree.find("visual/headlight")
        ambient = np.array(numbers(head.get("ambient"))) * self.random.uniform(0.75, 1.25)
        head.set("ambient", text_of(ambient))

    # Places

    def place(self, body):
        return np.array(numbers(body.get("pos", "0 0 0")))

    def yaw(self, body):
        """Degrees about the vertical, or None where a body is turned otherwise."""
        turn = numbers(body.get("euler", "0 0 0"))
        return None if turn[0] or turn[1] or "quat" in body.attrib else turn[2]

    def move(self, body, pivot, shift, turn_deg):
        """Turns a body about the vertical axis through pivot (x, y), then shifts it."""
        yaw, p = self.yaw(body), self.place(body)
        c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
        d = p[:2] - pivot
        p[:2] = pivot + np.array([c * d[0] - s * d[1], s * d[0] + c * d[1]]) + shift
        body.set("pos", text_of(p))
        if yaw is not None and (turn_deg or yaw):
            body.set("euler", text_of([0, 0, yaw + turn_deg]))

    def drop(self):
        """Some small things are not at home today; one of each class is, as the class file asks."""
        world = self.tree.find("worldbody")
        small = ON_TABLES | ON_FLOORS | {"picture", "cushion", "rug"}
        for body in [b for b in self.bodies if kind_of(b) in small and not b.get("name").endswith("_1")]:
            if self.chance(0.15):
                world.remove(body)
                self.bodies.remove(body)

    def swap(self, kinds, on_floor):
        """Things of these kinds change places with each other."""
        mine = [b for b in self.bodies if kind_of(b) in kinds and self.yaw(b) is not None
                and (self.place(b)[2] < 0.05) == on_floor and any(self.place(b))]
        places = [self.place(b) for b in mine]
        for body, n in zip(mine, self.random.permutation(len(mine))):
            if self.chance(0.7):
                body.set("pos", text_of(places[n]))

    def carried(self, furniture):
        """What stands on each piece of furniture: the nearest one within an arm's length below it."""
        groups = {id(f): [f] for f in furniture}
        for body in self.bodies:
            p = self.place(body)
            if body in furniture or p[2] < 0.2 or not any(p[:2]):
                continue
            far = [np.linalg.norm(self.place(f)[:2] - p[:2]) for f in furniture]
            if furniture and min(far) < 0.75:
                groups[id(furniture[int(np.argmin(far))])].append(body)
        return groups

    def rearrange(self):
        """Furniture moves with what stands on it; everything else moves by itself."""
        furniture = [b for b in self.bodies if kind_of(b) in FURNITURE and self.place(b)[2] < 0.2
                     and any(self.place(b)) and self.yaw(b) is not None]
        groups = self.carried(furniture)
        for body in self.bodies:
            kind = kind_of(body)
            if kind not in REACH or self.yaw(body) is None or not any(self.place(body)):
                continue
            along, out, turn = (self.random.uniform(-r, r) for r in REACH[kind])
            a = math.radians(self.yaw(body))
            shift = np.array([out * math.cos(a) - along * math.sin(a), out * math.sin(a) + along * math.cos(a)])
            pivot = self.place(body)[:2]
            for thing in groups.get(id(body), [body]):
                self.move(thing, pivot, shift, turn)

    def hang(self):
        """Pictures and screens of other sizes and heights."""
        for body in [b for b in self.bodies if kind_of(b) in ("picture", "tv", "clock", "mirror")]:
            wide, high = self.random.uniform(0.75, 1.25, 2) if self.chance(0.7) else (1, 1)
            p = self.place(body)
            if kind_of(body) == "picture" and any(p):
                body.set("pos", text_of(p + [0, 0, self.random.uniform(-0.2, 0.15)]))
            for geom in body.iter("geom"):
                size = numbers(geom.get("size", ""))
                if len(size) == 3 and "xyaxes" not in geom.attrib and "euler" not in geom.attrib:
                    geom.set("size", text_of(size * np.array([1, wide, high])))
                    geom.set("pos", text_of(np.array(numbers(geom.get("pos", "0 0 0"))) * [1, wide, high]))

    def varied(self):
        """The MJCF text. Meshes and textures are named by absolute paths: it may lie anywhere."""
        self.add_textures()
        self.dress_materials()
        self.drop()
        self.swap(ON_TABLES, on_floor=False)
        self.swap(ON_FLOORS, on_floor=True)
        self.rearrange()
        self.hang()
        self.paint_bodies()
        self.light()
        compiler = self.tree.find("compiler")
        compiler.set("meshdir", str(SCENES / "meshes"))
        compiler.set("texturedir", str(SCENES / "textures"))
        return xml.tostring(self.tree, encoding="unicode")
