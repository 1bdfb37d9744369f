#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes scenes/home.xml and its class file: living room, kitchen, corridor, bedroom, bathroom.

71 m2 within the outer walls.
"""

import pathlib
import sys

import fixtures
import furniture as put
import items
import shell
from scene_xml import Scene
from shell import DOOR

ABOUT = """A home of 9.6 m x 7.4 m: living room in the south-west, kitchen with the dining place in
     the north-west, a corridor from the front door in the south to the north wall, bathroom in the
     south-east, bedroom with a desk in the north-east. z = 0 is the floor, the ceiling is at 2.507.
     One body is one object, its class is its name up to the last _number.
     Written by scenes/tools/home.py: edit that, not this."""


def shell_of(scene):
    scene.section("the shell")
    shell.floor(scene, -0.107, 4.762, -0.093, 4.176, "planks")
    shell.floor(scene, -0.107, 4.762, 4.176, 7.547, "tiles_floor")
    shell.floor(scene, 4.762, 6.062, -0.093, 7.547, "planks")
    shell.floor(scene, 6.062, 9.733, -0.093, 2.276, "tiles_floor")
    shell.floor(scene, 6.062, 9.733, 2.276, 7.547, "carpet")
    shell.ceiling(scene, -0.107, 9.733, -0.093, 7.547)
    window_living, window_dining = (1.407, 3.013, 0.853, 2.147), (4.807, 5.913, 1.003, 2.147)
    window_bed, window_bath = (4.607, 6.113, 0.853, 2.147), (0.807, 1.513, 1.503, 2.147)
    window_sink = (1.903, 2.873, 1.103, 2.147)
    shell.wall(
        scene, "y", -0.047, 0.12, -0.093, 7.547, "paint", [window_living, window_dining], (1,)
    )
    shell.wall(scene, "y", 9.673, 0.12, -0.093, 7.547, "paint", [window_bath, window_bed], (-1,))
    shell.wall(scene, "x", -0.033, 0.12, 0.013, 9.613, "paint_clay", (), ())
    shell.wall(scene, "x", 7.487, 0.12, 0.013, 9.613, "paint", [window_sink], (-1,))
    door_living, door_kitchen = (2.603, 3.583, 0, DOOR), (4.903, 5.883, 0, DOOR)
    door_bath, door_bed = (0.903, 1.883, 0, DOOR), (3.303, 4.283, 0, DOOR)
    shell.wall(scene, "y", 4.762, 0.098, 0.027, 7.427, "paint", [door_living, door_kitchen])
    shell.wall(scene, "y", 6.062, 0.098, 0.027, 7.427, "paint", [door_bath, door_bed])
    shell.wall(scene, "x", 4.176, 0.098, 0.013, 4.713, "paint_sage", [(2.003, 3.403, 0, DOOR)])
    shell.wall(scene, "x", 2.276, 0.098, 6.111, 9.613, "paint_sky")
    scene.section("windows, curtains, radiators, doors")
    for at, (a, b, sill, lintel), outside in (
        (-0.047, window_living, -1),
        (-0.047, window_dining, -1),
        (9.673, window_bed, 1),
        (9.673, window_bath, 1),
    ):
        shell.window(scene, "y", at, 0.12, a, b, sill, lintel, outside)
    shell.window(scene, "x", 7.487, 0.12, *window_sink, 1)
    shell.curtains(scene, "y", 0.013, window_living[0], window_living[1], 1)
    shell.curtains(scene, "y", 9.613, window_bed[0], window_bed[1], -1, "drape_blue")
    shell.radiator(scene, 0.013, 2.211, 0, 1.1)
    shell.radiator(scene, 9.613, 5.361, 180, 1.1)
    shell.door_closed(scene, 5.413, 0.027, 90, material="walnut")
    for at, (a, b, _, _) in (
        (4.762, door_living),
        (4.762, door_kitchen),
        (6.062, door_bath),
        (6.062, door_bed),
    ):
        shell.frame(scene, "y", at, 0.098, a, b)
    shell.door_open(scene, 4.627, 2.585, 180)
    shell.door_open(scene, 6.197, 4.305, 0)
    shell.door_open(scene, 6.197, 0.887, 180, 0.82)


def living_room(scene):
    scene.section("living room")
    put.rug(scene, 2.113, 1.717, 0, 2.5, 1.7)
    put.sofa(scene, 2.113, 2.763, -90)
    for x, cloth, yaw in (
        (1.157, "ochre_cloth", -96),
        (2.997, "teal_cloth", -82),
        (2.777, "red_cloth", -101),
    ):
        items.cushion(
            scene,
            x,
            2.843 if cloth != "red_cloth" else 2.713,
            0.652,
            yaw,
            cloth,
            63 if cloth != "red_cloth" else 55,
        )
    top = put.coffee_table(scene, 2.113, 1.657, 2)
    items.cup(scene, 1.807, 1.713, top, 140)
    items.cup(scene, 2.437, 1.537, top, 20, "sun", True)
    items.book_pile(scene, 2.103, 1.697, top, 30, 3, 1)
    items.water(scene, 1.923, 1.493, top)
    put.armchair(scene, 0.703, 1.213, 17)
    items.cushion(scene, 0.607, 1.187, 0.652, 17, "red_cloth")
    top = put.board(scene, 2.113, 0.045, 90, 1.9)
    put.tv_on_stand(scene, 2.103, 0.247, top, 90, 1.24, "landscape")
    items.small_plant(scene, 2.937, 0.257, top)
    items.vase(scene, 1.277, 0.243, top, "cobalt")
    tops = put.shelf(scene, 4.697, 1.043, 180, 1.2)
    items.fill_shelf(scene, 4.697, 1.043, 180, tops, 1.2)
    put.plant(scene, 0.437, 0.427)
    put.plant(scene, 4.327, 0.293, "sword_plant", "teal_shell")
    put.floor_lamp(scene, 0.407, 3.607)
    put.round_table(scene, 0.393, 3.107, 0.24, 0.55)
    items.cup(scene, 0.423, 3.157, 0.55, 200, "mint")
    shell.picture(scene, 0.937, 4.127, 1.553, -90, 0.95, 0.63, "landscape")
    shell.picture(scene, 4.107, 4.127, 1.587, -90, 0.5, 0.67, "abstract", "dark")
    shell.picture(scene, 3.453, 0.027, 1.603, 90, 0.45, 0.6, "portrait")
    shell.clock(scene, 0.013, 3.453, 1.913, 0)
    items.pendant(scene, 2.113, 1.753, 2.053)


def kitchen_front(scene):
    scene.section("kitchen: the front along the north wall")
    run = fixtures.KitchenRun(scene, 0.027, 7.427, -90)
    run.fridge()
    run.tall_oven()
    run.cabinet(0.6, 3)
    run.sink(0.84)
    run.oven()
    run.cabinet(0.6, 2)
    run.cabinet(0.8)
    run.wall_cabinets(1.245, [0.6])
    run.wall_cabinets(3.3, [0.45, 0.45, 0.48])
    run.hood(2.68)
    run.splash(1.242, 1.86)
    run.splash(1.86, 2.86, top=1.064)
    run.splash(2.86, 4.682)
    top = fixtures.TOP
    items.kettle(scene, 1.447, 7.183, top, -60)
    for x, y, yaw, glaze in (
        (1.663, 7.213, -40, "sun"),
        (1.767, 7.097, 200, "porcelain"),
        (3.463, 7.013, 250, "cobalt"),
    ):
        items.cup(scene, x, y, top, yaw, glaze, glaze == "sun")
    items.soap(scene, 2.617, 7.357, top, -90)
    items.wine(scene, 3.427, 7.277, top)
    items.wine(scene, 3.553, 7.297, top)
    items.water(scene, 3.687, 7.237, top, "apple")
    items.pot(scene, 2.843, 7.233, top + 0.0095, 20)
    items.pan(scene, 3.123, 7.017, top + 0.0095, -75)
    items.fruit_bowl(scene, 4.387, 7.147, top)
    items.bowl(scene, 4.093, 7.193, top)


def dining_place(scene):
    scene.section("kitchen: the dining place")
    height = put.table(scene, 1.087, 5.337, 90, 1.6, 0.86, 0.753)
    for x, y, yaw in (
        (1.693, 4.943, 176),
        (1.717, 5.707, 187),
        (0.423, 4.937, 3),
        (0.413, 5.693, -5),
    ):
        put.dining_chair(scene, x, y, yaw)
    for x, y in ((1.343, 4.943), (1.347, 5.703), (0.827, 4.953)):
        items.plate(scene, x, y, height)
    items.vase(scene, 1.083, 5.367, height, "mint")
    items.wine(scene, 0.947, 5.557, height)
    items.water(scene, 1.203, 5.107, height)
    for x, y, yaw, glaze in (
        (1.237, 5.497, 60, "cherry"),
        (1.097, 4.823, -30, "porcelain"),
        (0.773, 5.243, 160, "cobalt"),
        (0.803, 5.763, 110, "mint"),
    ):
        items.cup(scene, x, y, height, yaw, glaze)
    items.pendant(scene, 1.087, 5.337, 1.673)
    top = put.chest(scene, 4.107, 4.239, 90, 0.96, 3, 0.83, 0.38, "birch")
    items.wine(scene, 3.793, 4.387, top)
    items.wine(scene, 3.893, 4.457, top)
    items.bowl(scene, 4.137, 4.423, top, "cobalt")
    items.small_plant(scene, 4.427, 4.407, top, "cobalt", 70)
    put.tv_on_wall(scene, 4.713, 6.353, 1.403, 180, 0.82)
    shell.picture(scene, 0.953, 4.225, 1.597, 90, 0.8, 0.55, "landscape", "oak")
    shell.picture(scene, 4.093, 4.225, 1.597, 90, 0.45, 0.6, "portrait", "dark")
    put.bin(scene, 4.517, 6.553)
    items.ceiling_lamp(scene, 3.107, 5.807)


def corridor(scene):
    scene.section("corridor")
    put.rug(scene, 5.413, 2.307, 90, 2.9, 0.72, "runner")
    put.rug(scene, 5.413, 0.557, 0, 0.76, 0.48, "mat")
    top = put.chest(scene, 5.999, 5.907, 180, 1.1, 2, 0.78, 0.29, "walnut")
    items.table_lamp(scene, 5.847, 6.287, top)
    items.bowl(scene, 5.857, 5.787, top, "sun")
    items.cup(scene, 5.843, 5.557, top, 215)
    shell.mirror(scene, 6.013, 5.907, 1.517, 180, 0.62, 0.93)
    tops = put.shelf(scene, 5.413, 7.413, -90, 1.0, 4, 0.34, "birch")
    for i, count in enumerate((11, 8, 12)):
        items.books(scene, 4.957, 7.413, tops[i], -90, count, 3 + i)
    put.box(scene, 5.683, 7.263, tops[1], -90, 0.22, 0.26, 0.19)
    items.vase(scene, 5.587, 7.253, tops[3], "sun")
    put.basket(scene, 4.447, 3.867)
    shell.picture(scene, 4.811, 1.403, 1.577, 0, 0.5, 0.66, "abstract")
    shell.picture(scene, 4.811, 4.243, 1.577, 0, 0.8, 0.52, "landscape", "oak")
    shell.picture(scene, 6.013, 2.593, 1.577, 180, 0.5, 0.66, "portrait")
    items.ceiling_lamp(scene, 5.413, 1.903)
    items.ceiling_lamp(scene, 5.413, 5.503)


def bedroom(scene):
    scene.section("bedroom")
    put.rug(scene, 8.003, 5.013, 0, 2.4, 1.4, "rug_blue")
    put.bed(scene, 8.003, 7.409, -90)
    for x, cup in ((6.823, False), (9.187, True)):
        top = put.chest(scene, x, 7.413, -90)
        items.table_lamp(scene, x + 0.06, 7.267, top, "cobalt")
        if cup:
            items.cup(scene, x - 0.127, 7.137, top, -100, "mint")
        else:
            items.water(scene, x - 0.137, 7.177, top)
            items.book_pile(scene, x + 0.017, 7.093, top, 80, 2, 4)
    items.cushion(scene, 8.003, 6.757, 0.687, -90, "ochre_cloth", 48)
    put.wardrobe(scene, 6.923, 2.339, 90)
    put.tv_on_wall(scene, 8.407, 2.325, 1.453, 90, 0.98, "screen")
    top = put.desk(scene, 9.599, 3.493, 180)
    items.monitor(scene, 9.353, 3.687, top, 176)
    items.laptop(scene, 9.237, 3.177, top, 166)
    items.cup(scene, 9.127, 4.017, top, 100, "sun", True)
    items.wine(scene, 9.467, 2.937, top)
    items.books(scene, 9.593, 4.163, top, 180, 6, 2)
    put.office_chair(scene, 8.713, 3.553, -12)
    put.shell_chair(scene, 6.597, 5.497, -24, "mustard_shell")
    top = put.chest(scene, 6.127, 6.253, 0, 0.86, 3, 0.82, 0.42)
    items.vase(scene, 6.337, 6.487, top, "porcelain")
    items.book_pile(scene, 6.333, 6.157, top, 10, 3, 3)
    put.basket(scene, 9.337, 6.687)
    put.plant(scene, 8.013, 2.557, "sword_plant")
    shell.picture(scene, 8.003, 7.427, 1.603, -90, 1.1, 0.6, "landscape", "oak")
    shell.picture(scene, 6.111, 6.253, 1.603, 0, 0.45, 0.6, "abstract", "dark")
    items.pendant(scene, 7.843, 4.693, 2.103)


def bathroom(scene):
    scene.section("bathroom, tiled to 2.1 m")
    walls = scene.body("wall", fixed=True)
    walls.panel(7.862, 0.027, 1.051, 3.502, 2.1, 0.008, "tiles_wall", "+y").panel(
        7.862, 2.227, 1.051, 3.502, 2.1, 0.008, "tiles_wall", "-y"
    )
    walls.panel(9.613, 1.127, 0.752, 2.2, 1.5, 0.008, "tiles_blue", "-x")
    fixtures.bath(scene, 9.601, 1.127, 180)
    fixtures.washstand(scene, 7.803, 2.213, -90)
    fixtures.toilet(scene, 8.203, 0.037, 90)
    fixtures.washing_machine(scene, 7.303, 0.039, 90)
    shell.mirror(scene, 7.803, 2.217, 1.557, -90, 0.6, 0.82)
    fixtures.towel(scene, 8.457, 2.217, 1.353, -90)
    fixtures.towel(scene, 6.713, 2.217, 1.253, -90, "towel_blue")
    items.soap(scene, 7.607, 2.127, 0.73, -90)
    items.soap(scene, 9.193, 0.313, 0.572, 180, "sun")
    items.soap(scene, 9.127, 0.367, 0.572, 120, "cherry")
    items.cup(scene, 8.037, 2.113, 0.73, -60, "porcelain")
    put.basket(scene, 6.583, 0.307)
    put.rug(scene, 8.453, 1.253, 90, 0.9, 0.55, "mat")
    items.small_plant(scene, 7.417, 0.213, 0.85, "porcelain", 20)
    items.water(scene, 7.187, 0.237, 0.85, "mint")
    items.ceiling_lamp(scene, 7.803, 1.127)


def home():
    scene = Scene("home", ABOUT, (4.8, 3.7, 1.1), 10)
    scene.lamp_light("living", 2.113, 1.753, 2.03, (0.24, 0.23, 0.21), True, 82, 1)
    scene.lamp_light("bedroom", 7.843, 4.693, 2.08, (0.19, 0.18, 0.165), False, 88, 0)
    scene.even_light("daylight", (0.75, -0.5, -0.55), (0.26, 0.27, 0.29))
    scene.even_light("bounce", (-0.55, 0.45, 0.75), (0.30, 0.285, 0.26))
    for room in (shell_of, living_room, kitchen_front, dining_place, corridor, bedroom, bathroom):
        room(scene)
    return scene


if __name__ == "__main__":
    home().write(
        sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    )
