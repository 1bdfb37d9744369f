#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes the curved things of the homes into scenes/meshes: closed, metres, as few facets as look
right."""

import pathlib
import sys

from foliage import ficus, sword_plant, tulips
from upholstery import (
    basin,
    chair_back,
    chair_seat,
    curtain,
    duvet,
    pillow,
    shell_chair,
    soft_block,
    toilet,
)
from vessels import (
    basket,
    bowl,
    flower_pot,
    kettle,
    lamp_foot,
    lamp_shade,
    mug,
    pan,
    plate,
    pot,
    soap_bottle,
    tap,
    vase,
    water_bottle,
    wine_bottle,
)


def all_meshes():
    stems, heads = tulips()
    return {
        "mug": mug(0.041, 0.095),
        "mug_low": mug(0.047, 0.074),
        "bowl": bowl(0.14, 0.075),
        "bowl_small": bowl(0.075, 0.055),
        "plate": plate(),
        "wine_bottle": wine_bottle(),
        "water_bottle": water_bottle(),
        "soap_bottle": soap_bottle(),
        "vase": vase(),
        "tulip_stems": stems,
        "tulip_heads": heads,
        "flower_pot": flower_pot(0.17, 0.3),
        "flower_pot_small": flower_pot(0.075, 0.13),
        "ficus": ficus(),
        "sword_plant": sword_plant(),
        "shade_floor": lamp_shade(0.21, 0.15, 0.26),
        "shade_table": lamp_shade(0.14, 0.08, 0.18),
        "shade_pendant": lamp_shade(0.2, 0.06, 0.18),
        "lamp_foot": lamp_foot(),
        "kettle": kettle(),
        "pot": pot(),
        "pan": pan(),
        "basket": basket(),
        "tap": tap(0.15, 0.24),
        "tap_low": tap(0.12, 0.17),
        "kitchen_sink": basin(0.2, 0.25, 0.17, 0.012, 7.0, 28, 0.9),
        "wash_basin": basin(0.215, 0.29, 0.13, 0.028, 3.4),
        "bath": basin(0.36, 0.83, 0.42, 0.05, 5.0, 32, 0.82),
        "toilet": toilet(),
        "pillow": pillow(0.22, 0.33, 0.075),
        "cushion": pillow(0.21, 0.21, 0.075),
        "soft_block": soft_block(),
        "curtain": curtain(0.52, 2.2, 5),
        "duvet": duvet(0.72, 0.83, 0.24),
        "duvet_single": duvet(0.7, 0.47, 0.22),
        "chair_seat": chair_seat(0.235, 0.235, 0.075),
        "chair_back": chair_back(0.43, 0.52, 0.07, 0.035),
        "chair_rail": chair_back(0.37, 0.1, 0.035, 0.018),
        "shell_chair": shell_chair(),
    }


def write_all(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, solid in all_meshes().items():
        solid.write(folder / f"{name}.obj")


if __name__ == "__main__":
    write_all(
        pathlib.Path(sys.argv[1])
        if len(sys.argv) > 1
        else pathlib.Path(__file__).resolve().parent.parent / "meshes"
    )
