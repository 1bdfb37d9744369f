#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes scenes/cottage.xml and its class file: a great room with the kitchen, hall, bedroom,
bathroom; 53 m2 within the outer walls."""

import pathlib
import sys

import fixtures
import furniture as put
import items
import shell
from scene_xml import Scene
from shell import DOOR

ABOUT = """A cottage of 7.9 m x 6.7 m: in the north one great room, kitchen in its east, sofa in its
     west, most of it askew; in the south bedroom, hall with the front door, bathroom. z = 0 is the
     floor, the ceiling is at 2.507. One body is one object, its class is its name up to the last _number;
     classes as in home.xml. Written by scenes/tools/cottage.py: edit that, not this."""


def shell_of(scene):
    scene.section("the shell")
    shell.floor(scene, -0.099, 8.041, 2.866, 6.835, "planks_grey")
    shell.floor(scene, -0.099, 3.572, -0.105, 2.866, "carpet")
    shell.floor(scene, 3.572, 5.168, -0.105, 2.866, "planks_grey")
    shell.floor(scene, 5.168, 8.041, -0.105, 2.866, "tiles_floor")
    shell.ceiling(scene, -0.099, 8.041, -0.105, 6.835)
    west, north, bed, bath = (
        (3.523, 4.717, 0.853, 2.147),
        (4.303, 6.107, 0.953, 2.147),
        (1.303, 2.307, 0.953, 2.147),
        (1.903, 2.507, 1.503, 2.147),
    )
    shell.wall(scene, "y", -0.039, 0.12, -0.105, 6.835, "paint", [bed, west], (1,))
    shell.wall(scene, "y", 7.981, 0.12, -0.105, 6.835, "paint_sky", [bath], (-1,))
    shell.wall(scene, "x", -0.045, 0.12, 0.021, 7.921, "paint", (), ())
    shell.wall(scene, "x", 6.775, 0.12, 0.021, 7.921, "paint_sage", [north], (-1,))
    door_hall, door_bed, door_bath = (
        (3.863, 4.863, 0, DOOR),
        (1.603, 2.583, 0, DOOR),
        (1.003, 1.983, 0, DOOR),
    )
    shell.wall(scene, "x", 2.866, 0.098, 0.021, 7.921, "paint", [door_hall])
    shell.wall(scene, "y", 3.572, 0.098, 0.015, 2.817, "paint_clay", [door_bed])
    shell.wall(scene, "y", 5.168, 0.098, 0.015, 2.817, "paint", [door_bath])
    scene.section("windows, curtains, radiators, doors")
    for at, (a, b, sill, lintel), outside in (
        (-0.039, west, -1),
        (-0.039, bed, -1),
        (7.981, bath, 1),
    ):
        shell.window(scene, "y", at, 0.12, a, b, sill, lintel, outside)
    shell.window(scene, "x", 6.775, 0.12, *north, 1)
    shell.curtains(scene, "x", 6.715, north[0], north[1], -1, "drape_blue")
    shell.curtains(scene, "y", 0.021, west[0], west[1], 1)
    shell.radiator(scene, 5.207, 6.715, -90, 1.2)
    shell.radiator(scene, 0.021, 4.117, 0, 0.9)
    shell.door_closed(scene, 4.373, 0.015, 90, material="oak")
    shell.frame(scene, "x", 2.866, 0.098, *door_hall[:2])
    shell.frame(scene, "y", 3.572, 0.098, *door_bed[:2])
    shell.frame(scene, "y", 5.168, 0.098, *door_bath[:2])
    shell.door_open(scene, 4.893, 2.977, -82, 0.94, "birch")
    shell.door_open(scene, 5.307, 0.983, 176, 0.84, "birch")


def living_place(scene):
    scene.section("great room: the living place in the west")
    put.rug(scene, 1.857, 4.973, 24, 2.1, 1.5, "rug_blue")
    put.sofa(scene, 1.437, 3.743, 72, 2, "moss_cloth", "moss_cloth")
    items.cushion(scene, 0.913, 3.787, 0.652, 64, "red_cloth")
    items.cushion(scene, 1.993, 3.467, 0.652, 80, "ochre_cloth")
    top = put.round_table(scene, 1.763, 4.993, 0.39, 0.423, "oak")
    items.cup(scene, 1.583, 4.883, top, 77, "cherry")
    items.cup(scene, 1.937, 5.137, top, 190, "porcelain", True)
    items.book_pile(scene, 1.857, 4.857, top, 50, 3, 2)
    items.water(scene, 1.627, 5.157, top, "mint")
    put.armchair(scene, 3.073, 5.347, 152, "sofa_cloth")
    items.cushion(scene, 3.163, 5.297, 0.652, 152, "teal_cloth")
    top = put.board(scene, 1.787, 6.701, -90, 1.5, "oak")
    put.tv_on_stand(scene, 1.743, 6.473, top, -97, 1.08, "film")
    items.vase(scene, 1.177, 6.503, top, "porcelain")
    items.cup(scene, 2.397, 6.443, top, -60, "mint")
    tops = put.shelf(scene, 0.037, 5.507, 0, 1.0, 5, 0.36, "birch")
    items.fill_shelf(scene, 0.037, 5.507, 0, tops, 1.0, (9, 6, 10, 7, 8))
    put.floor_lamp(scene, 0.383, 6.433)
    put.plant(scene, 3.253, 6.363, "ficus", "cobalt", 40)
    put.plant(scene, 0.327, 3.223, "sword_plant", "terracotta", 25)
    shell.picture(scene, 2.957, 2.915, 1.503, 90, 0.5, 0.66, "abstract", "dark")
    shell.picture(scene, 1.437, 2.915, 1.553, 90, 1.0, 0.62, "landscape", "oak")
    shell.picture(scene, 3.203, 6.715, 1.603, -90, 0.5, 0.66, "portrait")
    shell.clock(scene, 3.737, 6.715, 1.853, -90)
    items.ceiling_lamp(scene, 1.957, 4.853)


def kitchen_place(scene):
    scene.section("great room: the kitchen front along the east wall")
    run = fixtures.KitchenRun(scene, 7.907, 6.697, 180, "front_green")
    run.fridge()
    run.tall_oven()
    run.sink(0.82)
    run.oven()
    run.cabinet(0.6, 3)
    run.wall_cabinets(1.243, [0.41, 0.41])
    run.wall_cabinets(2.667, [0.59])
    run.hood(2.063)
    run.splash(1.242, 3.262)
    top = fixtures.TOP
    items.soap(scene, 7.823, 5.363, top, 180, "sun")
    items.kettle(scene, 7.613, 3.913, top, 140, "cobalt")
    items.cup(scene, 7.523, 3.637, top, 100, "sun")
    items.cup(scene, 7.697, 3.587, top, 250, "cherry", True)
    items.wine(scene, 7.797, 3.757, top)
    items.water(scene, 7.807, 5.287, top)
    items.pot(scene, 7.687, 4.493, top + 0.0095, 35, "cherry")
    items.pan(scene, 7.497, 4.187, top + 0.0095, 165)
    items.bowl(scene, 7.537, 4.713, top, "mint")
    put.bin(scene, 7.737, 3.157, 0.12, 0.4)
    scene.section("great room: the round dining table")
    x, y = 5.623, 5.087
    height = put.round_table(scene, x, y, 0.53, 0.743)
    put.shell_chair(scene, 6.047, 5.583, 229)
    put.shell_chair(scene, 5.067, 5.453, -33, "mustard_shell")
    put.dining_chair(scene, 5.143, 4.547, 48, "birch")
    put.dining_chair(scene, 6.153, 4.687, 143, "birch")
    items.fruit_bowl(scene, 5.647, 5.123, height)
    for px, py in ((5.373, 5.247), (5.837, 4.893), (5.413, 4.887)):
        items.plate(scene, px, py, height)
    for px, py, yaw, glaze in (
        (5.577, 5.387, 20, "cobalt"),
        (5.943, 5.107, 130, "porcelain"),
        (5.577, 4.763, -70, "mint"),
    ):
        items.cup(scene, px, py, height, yaw, glaze)
    items.wine(scene, 5.833, 5.293, height)
    items.water(scene, 5.493, 5.053, height)
    items.pendant(scene, x, y, 1.663)
    put.bar_stool(scene, 7.087, 3.193, 117)
    top = put.chest(scene, 6.353, 2.927, 90, 0.9, 3, 0.83, 0.36, "walnut")
    items.table_lamp(scene, 6.057, 3.097, top)
    items.books(scene, 6.553, 2.917, top, 90, 7, 1)
    put.tv_on_wall(scene, 6.353, 2.915, 1.437, 90, 0.84, "landscape")


def hall(scene):
    scene.section("hall")
    put.rug(scene, 4.373, 0.513, 3, 0.76, 0.48, "mat")
    top = put.chest(scene, 3.633, 0.863, 0, 0.96, 2, 0.78, 0.29)
    items.small_plant(scene, 3.793, 1.157, top, "cobalt", 15)
    items.bowl(scene, 3.787, 0.653, top)
    shell.mirror(scene, 3.621, 0.863, 1.517, 0, 0.55, 0.85)
    shell.picture(scene, 5.119, 2.397, 1.553, 180, 0.45, 0.6, "portrait")
    put.basket(scene, 4.887, 0.273)
    items.ceiling_lamp(scene, 4.373, 1.507)


def bedroom(scene):
    scene.section("bedroom")
    put.bed(scene, 0.035, 0.633, 0, double=False, wood="birch")
    items.cushion(scene, 0.473, 0.637, 0.66, 0, "red_cloth", 48)
    top = put.chest(scene, 0.035, 1.387, 0, 0.42, 2, 0.48, 0.36, "birch")
    items.table_lamp(scene, 0.197, 1.453, top, "mustard_shell")
    items.cup(scene, 0.307, 1.293, top, 33, "cobalt")
    put.wardrobe(scene, 2.983, 0.029, 90, 2)
    top = put.desk(scene, 1.303, 2.803, -90, 1.3, "oak")
    items.monitor(scene, 1.347, 2.593, top, -83, 0.54)
    items.laptop(scene, 0.917, 2.467, top, -104)
    items.cup(scene, 1.747, 2.423, top, -45, "sun", True)
    items.wine(scene, 1.857, 2.657, top)
    put.office_chair(scene, 1.277, 1.953, 71, "red_cloth")
    put.rug(scene, 1.657, 1.463, 7, 1.3, 0.6, "mat")
    put.tv_on_wall(scene, 3.523, 1.107, 1.403, 180, 0.78, "screen")
    shell.picture(scene, 1.013, 0.015, 1.503, 90, 0.8, 0.52, "landscape", "oak")
    shell.curtains(scene, "y", 0.021, 1.303, 2.307, 1, "drape_blue")
    items.pendant(scene, 1.763, 1.503, 2.103)


def bathroom(scene):
    scene.section("bathroom, tiled to 2.1 m on two walls")
    walls = scene.body("wall", fixed=True)
    walls.panel(6.569, 0.015, 1.051, 2.702, 2.1, 0.008, "tiles_blue", "+y").panel(
        6.569, 2.817, 1.051, 2.702, 2.1, 0.008, "tiles_wall", "-y"
    )
    fixtures.bath(scene, 7.043, 0.027, 90)
    fixtures.washstand(scene, 6.383, 2.805, -90)
    fixtures.toilet(scene, 7.911, 1.507, 180)
    fixtures.washing_machine(scene, 7.593, 2.803, -90)
    shell.mirror(scene, 6.383, 2.807, 1.557, -90, 0.55, 0.8)
    fixtures.towel(scene, 5.623, 2.807, 1.303, -90, "towel_blue")
    fixtures.towel(scene, 7.921, 0.553, 1.353, 180)
    items.soap(scene, 6.187, 2.717, 0.73, -70, "cherry")
    items.soap(scene, 6.337, 0.143, 0.572, 60)
    items.cup(scene, 6.613, 2.703, 0.73, 230, "porcelain")
    items.small_plant(scene, 7.447, 2.643, 0.85, "terracotta", 100)
    put.basket(scene, 5.463, 2.553)
    put.rug(scene, 6.713, 1.203, -8, 0.9, 0.55, "mat")
    items.ceiling_lamp(scene, 6.563, 1.507)


def cottage():
    scene = Scene("cottage", ABOUT, (4.0, 3.4, 1.1), 9)
    scene.lamp_light("dining", 5.623, 5.087, 1.64, (0.26, 0.25, 0.22), True, 82, 1)
    scene.lamp_light("living", 1.957, 4.353, 2.35, (0.20, 0.19, 0.17), False, 88, 0)
    scene.even_light("daylight", (0.55, -0.75, -0.55), (0.26, 0.27, 0.29))
    scene.even_light("bounce", (-0.5, 0.5, 0.75), (0.30, 0.285, 0.26))
    for place in (shell_of, living_place, kitchen_place, hall, bedroom, bathroom):
        place(scene)
    return scene


if __name__ == "__main__":
    cottage().write(
        sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    )
