# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Boxes of detections by docs/metrics.md: of the points that a segmentation kept, against what the depth image saw."""

import numpy as np

from map_scores import ratio

LEAST_IOUS = {"box_25": 0.25, "box_50": 0.5, "box_75": 0.75}


def widened_box(points, voxel):
    """Lower and upper corner of the axis-aligned box, half a voxel wider on each side."""
    return points.min(axis=0) - voxel / 2, points.max(axis=0) + voxel / 2


def volume(low, high):
    return float(np.prod(np.maximum(0, high - low)))


def box_iou(points, samples, voxel):
    """Rounded to whole billionths."""
    box, true_box = widened_box(points, voxel), widened_box(samples, voxel)
    shared = volume(np.maximum(box[0], true_box[0]), np.minimum(box[1], true_box[1]))
    return np.rint(1e9 * shared / (volume(*box) + volume(*true_box) - shared)) / 1e9


def box_ious(recording, frame, detections, voxel):
    """class -> (IoUs of the detections whose instance the depth image shows, how many others); a skipped one has 0."""
    _, depth_path, depth_label_path, _ = frame
    cloud = recording.cloud(recording.read_depth(depth_path))
    instances = recording.read_image(depth_label_path).reshape(-1)
    ious, unseen = {}, {}
    for instance, kept in detections:
        label = int(recording.class_of[instance])
        samples = cloud[(instances == instance) & (cloud[:, 2] > 0)]
        if len(samples) == 0:
            unseen[label] = unseen.get(label, 0) + 1
        else:
            ious.setdefault(label, []).append(box_iou(kept, samples, voxel) if len(kept) else 0.0)
    return {label: (np.array(ious.get(label, ())), unseen.get(label, 0)) for label in recording.names}


def box_figures(ious, unseen):
    shares = {name: ratio(int((ious >= least).sum()), len(ious)) for name, least in LEAST_IOUS.items()}
    return {"boxes": len(ious), "boxes_unseen": unseen, "box_iou": ratio(float(ious.sum()), len(ious)), **shares}
