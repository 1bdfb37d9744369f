# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Runs the program, and records small drives with it."""

import os
import subprocess

import yaml

CAMERAS = {"width_px": 160, "height_px": 120}


def program(*arguments):
    return subprocess.run(arguments, check=True, stdout=subprocess.PIPE, text=True).stdout


def record(mapscore, scene, trajectory, folder):
    """Path of a recording of the drive, made below the folder."""
    file, recording = os.path.join(folder, "drive.yaml"), os.path.join(folder, "recording")
    study = {"scene": scene, "trajectory": trajectory, "cameras": CAMERAS,
             "methods": {"direct": {"segmentation": {"direct": {}}}}}
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump(study, text)
    program(mapscore, "record", file, "-o", recording, "-q")
    return recording
