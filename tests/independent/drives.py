# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Runs the program, and records small drives with it."""

import os
import shutil
import subprocess

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
CORNER = ("corner.xml", "corner.classes.yaml")
CAMERAS = {"width_px": 160, "height_px": 120}


def program(*arguments):
    return subprocess.run(arguments, check=True, stdout=subprocess.PIPE, text=True).stdout


def corner_scene(scenes, folder):
    """Path of corner.xml with its classes and the robot, copied to the folder."""
    for source in (os.path.join(scenes, "robot.xml"), *(os.path.join(HERE, name) for name in CORNER)):
        shutil.copy(source, folder)
    return os.path.join(folder, "corner.xml")


def study_of(scene, trajectory, folder, **more):
    """Path of a study file of the drive."""
    file = os.path.join(folder, "drive.yaml")
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump({"scene": scene, "trajectory": trajectory, "cameras": CAMERAS,
                        "methods": {"direct": {"segmentation": {"direct": {}}}}, **more}, text)
    return file


def record(mapscore, scene, trajectory, folder):
    """Path of a recording of the drive, made below the folder."""
    recording = os.path.join(folder, "recording")
    program(mapscore, "record", study_of(scene, trajectory, folder), "-o", recording, "-q")
    return recording
