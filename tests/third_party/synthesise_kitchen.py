# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Makes one of scene-synthesizer's kitchens and converts it to MJCF: synthesise_kitchen.py KIND FILE.xml"""

import os
import random
import sys

import mujoco
import numpy as np
from scene_synthesizer import procedural_scenes


def main(kind, file):
    random.seed(5)
    np.random.seed(5)
    file = os.path.abspath(file)
    folder = os.path.dirname(file)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    kitchen = getattr(procedural_scenes, kind)()
    kitchen.export("kitchen.urdf")
    spec = mujoco.MjSpec.from_file("kitchen.urdf")
    spec.compiler.discardvisual = False
    spec.compiler.fusestatic = False
    spec.compile()
    with open(file, "w", encoding="utf-8") as text:
        text.write(spec.to_xml())


if __name__ == "__main__":
    main(*sys.argv[1:])
