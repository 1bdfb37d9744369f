#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""An independent ruler: maps and scores a recording from scratch, written from the design and the file format alone.

ruler.py RECORDING --method direct --misregistration_m 0.02 0 0 -o counts.csv     figures: class,metric,value
ruler.py truth RECORDING -o truth.csv                                             i,j,k,class,touch_only,samples
"""

import argparse
import csv
import re
import sys

import numpy as np

sys.dont_write_bytecode = True

from boxes import box_ious
from drive_scores import DriveScores
from fusion import Blend, FusedMap, hits_of
from map_scores import joined_of
from recording import Recording, map_from_world, moved
from segmentation import exponential, observe, observe_depth_labels
from sights import exact_sight
from truth import Samples, surface_truth, unpack, visible_truth, voxels_of


def depth_samples(recording, frame, T_map_world):
    """Noise-free samples of a frame in frame map, and the class of each."""
    _, depth_path, depth_label_path, T_world_base = frame
    cloud = recording.cloud(recording.read_depth(depth_path))
    classes = recording.classes_of(recording.read_image(depth_label_path)).reshape(-1)
    valid = cloud[:, 2] > 0
    return moved(T_map_world @ T_world_base @ recording.T_base_depth, cloud[valid]), classes[valid]


def maps_of(recording, options):
    """Raw scores of every map of the drive, one for all frames or one a frame."""
    T_map_world = map_from_world(options.origin_m, np.radians(options.yaw_deg))
    geoms = recording.geoms(T_map_world)
    surface = surface_truth(geoms, options.voxel_m, options.epsilon_m)
    scores = DriveScores(recording, geoms, surface, options.voxel_m)
    error = np.eye(4)
    error[:3, :3] = exponential(np.radians(options.rotation_deg))
    error[:3, 3] = options.misregistration_m
    believed = error @ recording.T_color_depth
    maps, frames = [], recording.frames
    for group in [[frame] for frame in frames] if options.unit == "frame" else [frames]:
        fused, seen, parts = FusedMap(Blend(max(recording.names) + 1, K=options.K)), Samples(), []
        for frame in group:
            points, classes, scores_of_points, detections = (
                observe_depth_labels(recording, frame, options) if options.labels == "depth_label" else
                observe(recording, exact_sight(recording, frame), options, believed))
            placed = moved(T_map_world @ frame[3] @ recording.T_base_depth, points)
            one_draw = voxels_of(placed, options.voxel_m), classes, scores_of_points
            fused.add(*hits_of([one_draw], fused.rule.class_count))
            samples, sample_classes = depth_samples(recording, frame, T_map_world)
            seen.add(voxels_of(samples, options.voxel_m), sample_classes)
            parts.append((samples, sample_classes, box_ious(recording, frame, detections, options.voxel_m)))
        samples, sample_classes, boxes = zip(*parts)
        maps.append(scores.of_map(
            fused.voxels(), (1 - options.K) / 2, visible_truth(seen, surface, options.min_samples),
            np.concatenate(samples), np.concatenate(sample_classes),
            {label: tuple(joined_of(column) for column in zip(*(one[label] for one in boxes))) for label in boxes[0]}))
    return scores, maps


def score(recording, options):
    """(class name, metric) -> int, float or None, of all maps of the drive together, as the program tells them."""
    scores, maps = maps_of(recording, options)
    return scores.figures(maps)


def score_rows(recording, options):
    scores, maps = maps_of(recording, options)
    figures = {**scores.figures(maps), **scores.own_counts(maps)}
    return [("class", "metric", "value")] + [
        (*key, "-" if value is None else f"{value:.9g}") for key, value in sorted(figures.items())]


def truth_rows(recording, options):
    T_map_world = map_from_world(options.origin_m, np.radians(options.yaw_deg))
    surface = surface_truth(recording.geoms(T_map_world), options.voxel_m, options.epsilon_m)
    seen = Samples()
    for frame in recording.frames:
        samples, classes = depth_samples(recording, frame, T_map_world)
        seen.add(voxels_of(samples, options.voxel_m), classes)
    visible = visible_truth(seen, surface, options.min_samples)
    rows = []
    for label, cells in surface.items():
        if label == 0 and not options.with_background:
            continue
        for key, touch_only in cells.items():
            indices = unpack(np.int64(key)).tolist()
            rows.append((*indices, label, int(touch_only), visible[label].get(key, 0)))
    names = recording.names
    return [("i", "j", "k", "class", "touch_only", "samples")] + [
        (i, j, k, names[label], touch, samples) for i, j, k, label, touch, samples in sorted(rows)]


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser._negative_number_matcher = re.compile(r"^-[\d.]+([eE][-+]?\d+)?$")  # or argparse takes -1e-3 for a flag
    truth_only = arguments[:1] == ["truth"]
    parser.add_argument("recording")
    parser.add_argument("--voxel_m", type=float, default=0.05)
    parser.add_argument("--origin_m", type=float, nargs=3, default=(0, 0, 0))
    parser.add_argument("--yaw_deg", type=float, default=0)
    parser.add_argument("--epsilon_m", type=float, default=0.0005)
    parser.add_argument("--min_samples", type=int, default=1)
    parser.add_argument("-o", "--output", default="-")
    if truth_only:
        parser.add_argument("--with_background", action="store_true")
    else:
        parser.add_argument("--method", choices=("direct", "erosion", "region_growing"), default="direct")
        parser.add_argument("--radius_px", type=float, default=5)
        parser.add_argument("--radius_factor", type=float, choices=(1, 0.5), default=1)
        parser.add_argument("--misregistration_m", type=float, nargs=3, default=(0, 0, 0))
        parser.add_argument("--rotation_deg", type=float, nargs=3, default=(0, 0, 0))
        parser.add_argument("--unit", choices=("map", "frame"), default="map")
        parser.add_argument("--place", choices=("points", "voxels"), default="points")
        parser.add_argument("--K", type=float, default=0.5)
        parser.add_argument("--labels", choices=("color", "depth_label"), default="color")
    return truth_only, parser.parse_args(arguments[truth_only:])


def main(arguments):
    truth_only, options = parse(arguments)
    recording = Recording(options.recording)
    rows = (truth_rows if truth_only else score_rows)(recording, options)
    with (sys.stdout if options.output == "-" else open(options.output, "w", encoding="utf-8", newline="")) as text:
        csv.writer(text, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1:])
