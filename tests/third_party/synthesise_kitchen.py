# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Makes one of scene-synthesizer's kitchens and converts it to MJCF: synthesise_kitchen.py KIND FILE.xml"""

import os
import sys

import mujoco
from scene_synthesizer import procedural_scenes


SEED = 5


def main(kind, file):
    file = os.path.abspath(file)
    folder = os.path.dirname(file)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    kitchen = getattr(procedural_scenes, kind)(seed=SEED)
    kitchen.export("kitchen.urdf")
    spec = mujoco.MjSpec.from_file("kitchen.urdf")
    spec.compiler.discardvisual = False
    spec.compiler.fusestatic = False
    spec.compile()
    with open(file, "w", encoding="utf-8") as text:
        text.write(spec.to_xml())


if __name__ == "__main__":
    main(*sys.argv[1:])
