# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What a method is given of a frame: its depth image and detections, exact or under faults."""

from dataclasses import dataclass

import numpy as np

from depth_faults import measured
from label_faults import noisy_masks, verdict


@dataclass
class Sight:
    z: np.ndarray  # planar, of each depth pixel, 0: none
    labels: np.ndarray  # instance of each colour pixel
    detections: dict  # instance -> (class, score), ascending


def detected_instances(recording):
    return {n for n, label in enumerate(recording.class_of.tolist()) if label in recording.detected}


def exact_sight(recording, frame):
    labels = recording.read_image(frame[0])
    recording.classes_of(labels)
    shown = sorted(detected_instances(recording) & set(np.unique(labels).tolist()))
    return Sight(recording.read_depth(frame[1]), labels, {n: (int(recording.class_of[n]), 1.0) for n in shown})


def faulty_sight(recording, number, faults, seed):
    """Of the frame of that number, under a study's faults of depth and labels, with the draws of a trial's seed."""
    frame, classes = recording.frames[number], sorted(recording.detected)
    sight = exact_sight(recording, frame)
    if "depth" in faults:
        stored = measured(recording.read_image(frame[1]), recording.depth, faults["depth"], seed,
                          recording.depth_number(frame))
        sight.z = recording.depth_of(stored)
    if "labels" in faults:
        sight.labels = noisy_masks(sight.labels, detected_instances(recording), faults["labels"], seed, number)
        sight.detections = {n: verdict(label, classes, faults["labels"], seed, number, n)
                            for n, (label, _) in sight.detections.items() if (sight.labels == n).any()}
    return sight
