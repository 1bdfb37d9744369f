#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds the noisy images that `mapscore record --bake` writes against the independent ruler's, pixel by pixel.

faulty_images.py PROGRAM SCENES depth|labels    records a drive through corner.xml under each effect by itself, and under all
"""

import os
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True

from depth_faults import measured
from drives import corner_scene, program, record, study_of
from label_faults import noisy_masks
from recording import Recording
from sights import detected_instances
from streams import trial_seed

SEED = 1  # a study's default
TRAJECTORY = {"waypoints_m_deg": [[0.213, 0.317, 37], [0.157, 1.013, 11], [0.423, 1.437, 3]], "frames_per_s": 1.1,
              "depth_frames_per_s": 1.7}
DOSES = {
    "depth": {
        "shadow": [{"shadow": 1}, {"shadow": 2.3, "baseline_m": 0.061}],
        "grazing": [{"grazing": 1}, {"grazing": 0.7, "grazing_from_deg": 13, "grazing_to_deg": 61}],
        "flying": [{"flying": 1}, {"flying": 6.1, "flying_share": 0.13}],
        "lateral": [{"lateral": 1}, {"lateral": 3.7, "lateral_px": 0.31}],
        "axial": [{"axial": 1}, {"axial": 2.9, "axial_base_m": 0.0031, "axial_growth_per_m": 0.0007}],
        "quantisation": [{"quantisation": 1}, {"quantisation": 7.3, "subpixel_px": 0.21, "baseline_m": 0.061}],
        "range": [{"range": 0.6, "range_min_m": 1.53, "range_max_m": 2.17}],
        "all effects in their order": [
            {"preset": "astra"}, {"preset": "kinect_v1", "scale": 2.3, "flying": 3.1, "range_min_m": 1.3}]},
    "labels": {
        "miss": [{"miss": 0.9}, {"miss": 0.7, "miss_area_px": 137}],
        "boundary": [{"boundary_px": dose} for dose in (-3, -0.5, 1.5, 3, 13)],
        "ragged": [{"ragged_px": 1.3}, {"ragged_px": 3.1, "ragged_length_px": 5.3, "boundary_px": 1.7}],
        "holes": [{"holes": 0.1}, {"holes": 0.4, "disc_radius_px": 2, "boundary_px": 3}],
        "islands": [{"islands": 0.1}, {"islands": 0.3, "disc_radius_px": 2, "island_reach_px": 13}],
        "all effects in their order": [
            {"preset": "typical"}, {"preset": "typical", "scale": 2.5}, {"preset": "typical", "scale": 1.9, "boundary_px": 1.1, "miss": 0.1, "holes": 0.3, "islands": 0.4}]}}


def image_differences(images, what):
    """Lines of differences, pixels and how many of them the fault changed; images: (number, exact, program's, ruler's)."""
    lines, pixels, changed = [], 0, 0
    for number, exact, ours, theirs in images:
        pixels, changed = pixels + exact.size, changed + int((theirs != exact).sum())
        for v, u in np.argwhere(ours != theirs).tolist():
            lines.append(f"  {what}: image {number}, pixel ({u}, {v}): {exact[v, u]}, "
                         f"program {ours[v, u]}, ruler {theirs[v, u]}")
    return lines, pixels, changed


def depth_images(exact, noisy, keys):
    for number, (path, noisy_path) in enumerate(zip(exact.depth_paths(), noisy.depth_paths())):
        stored = exact.read_image(path)
        yield number, stored, noisy.read_image(noisy_path), measured(stored, exact.depth, keys, trial_seed(SEED), number)


def label_images(exact, noisy, keys):
    for number, (frame, noisy_frame) in enumerate(zip(exact.frames, noisy.frames)):
        labels = exact.read_image(frame[0])
        yield number, labels, noisy.read_image(noisy_frame[0]), noisy_masks(
            labels, detected_instances(exact), keys, trial_seed(SEED), number)


IMAGES = {"depth": depth_images, "labels": label_images}


def main(mapscore, scenes, what):
    mapscore, failed = os.path.abspath(mapscore), False
    with tempfile.TemporaryDirectory() as folder:
        scene = corner_scene(scenes, folder)
        exact = Recording(record(mapscore, scene, TRAJECTORY, folder))
        for effect, doses in DOSES[what].items():
            for n, keys in enumerate(doses):
                baked = os.path.join(folder, f"{effect}-{n}")
                study = study_of(scene, TRAJECTORY, folder, faults={what: keys})
                program(mapscore, "record", study, "-o", baked, "-q", "--bake")
                name = f"{effect} ({', '.join(f'{key}: {value}' for key, value in keys.items())})"
                lines, pixels, changed = image_differences(IMAGES[what](exact, Recording(baked), keys), name)
                print(f"{name}: {pixels} pixels compared, {changed} of them changed, {len(lines)} differ", flush=True)
                print("\n".join(lines[:20]), end="\n" if lines else "")
                failed |= bool(lines) or pixels == 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
