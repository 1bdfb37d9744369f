#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""An independent ruler: maps and scores a recording from scratch, written from the design and the file format alone.

ruler.py RECORDING --method direct --misregistration_m 0.02 0 0 -o counts.csv     counts by class: class,metric,value
ruler.py truth RECORDING -o truth.csv                                             i,j,k,class,touch_only,samples
"""

import argparse
import csv
import re
import sys

import numpy as np
from scipy.spatial import cKDTree

sys.dont_write_bytecode = True

from recording import Recording, map_from_world, moved
from segmentation import exponential, observe
from surfaces import SLACK, distance_to_boxes
from truth import Samples, cubes_of, grown, key_sets, surface_truth, unpack, visible_truth, voxels_of

TAUS_CM = (1, 2, 5, 10)


def depth_samples(recording, frame, T_map_world):
    """Noise-free samples of a frame in frame map, and the class of each."""
    _, depth_path, depth_label_path, T_world_base = frame
    cloud = recording.cloud(recording.read_depth(depth_path))
    classes = recording.classes_of(recording.read_image(depth_label_path)).reshape(-1)
    valid = cloud[:, 2] > 0
    return moved(T_map_world @ T_world_base @ recording.T_base_depth, cloud[valid]), classes[valid]


def winners(keys, labels):
    """Per voxel the class of most points, ties to the lower id."""
    samples = Samples()
    samples.add(keys, labels)
    return samples.owners()[:2]


class Map:
    """Blend with one draw: M = K M + (1 - K) O for the voxels that a frame hits."""

    def __init__(self, K, class_count):
        self.K, self.class_count, self.cells = K, class_count, {}

    def add(self, keys, labels):
        for key, label in zip(keys.tolist(), labels.tolist()):
            cell = self.cells.setdefault(key, np.zeros(self.class_count))
            cell *= self.K
            cell[label] += 1 - self.K

    def prediction(self):
        """key -> class, or -1 below the threshold."""
        threshold = (1 - self.K) / 2
        return {key: int(cell.argmax()) if cell.max() >= threshold else -1 for key, cell in self.cells.items()}


def cube_distances(points, keys, voxel):
    """Distance from each point to the nearest of the closed cubes. The cube with the nearest centre need not be the
    nearest cube, so more centres are asked for until none farther away can win."""
    best = np.full(len(points), np.inf)
    if len(keys) == 0 or len(points) == 0:
        return best
    best[np.isin(voxels_of(points, voxel), keys)] = 0
    low, high = cubes_of(keys, voxel)
    tree = cKDTree((low + high) / 2)
    open_ = np.flatnonzero(best > 0)
    count = 8
    while len(open_):
        count = min(count, len(keys))
        rest = []
        for part in np.array_split(open_, len(open_) // 100_000 + 1):
            centre, nearest = tree.query(points[part], k=count)
            centre, nearest = centre.reshape(len(part), -1), nearest.reshape(len(part), -1)
            distance = distance_to_boxes(points[part][:, None], low[nearest], high[nearest]).min(axis=1)
            best[part] = distance
            if count < len(keys):
                rest.append(part[centre[:, -1] - voxel * np.sqrt(3) / 2 <= distance])
        open_ = np.concatenate(rest) if rest else []
        count *= 4
    return best


def surface_distances(keys, shapes, voxel):
    """Distance from each closed cube to the nearest boundary of the shapes."""
    best = np.full(len(keys), np.inf)
    low, high = cubes_of(keys, voxel)
    for shape in shapes:  # touching ones first: they are cheap and rule out most of the rest
        best[shape.boundary_meets(low - SLACK, high + SLACK)] = 0
    for shape in shapes:
        first, last = shape.bounds()
        gap = np.linalg.norm(np.maximum(0, np.maximum(first - high, low - last)), axis=1)
        todo = np.flatnonzero(gap < best)
        best[todo] = np.minimum(best[todo], shape.boundary_distance(low[todo], high[todo]))
    return best


class Scores:
    """Sums by class and metric; the means are formed at the end."""

    def __init__(self, recording, geoms, surface, voxel):
        self.labels = sorted(label for label in recording.names if label != 0)
        self.names, self.voxel, self.surface = recording.names, voxel, key_sets(surface)
        self.shapes = {label: [shape for owner, shape in geoms if owner == label] for label in self.labels}
        self.near = {label: grown(keys) for label, keys in self.surface.items()}
        self.sums = {label: {} for label in self.labels}

    def count(self, label, metric, value):
        self.sums[label][metric] = self.sums[label].get(metric, 0) + value

    def add_voxels(self, prediction, visible):
        """Counts and distances of one map against the visible truth of the frames in it; returns P by class."""
        keys = np.array(sorted(prediction), np.int64)
        labels = np.array([prediction[key] for key in keys.tolist()], np.int64)
        empty = np.zeros(0, np.int64)
        predicted = {label: keys[labels == label] for label in self.labels}
        for label in self.labels:
            mine, surface = predicted[label], self.surface.get(label, empty)
            seen = np.array(sorted(visible.get(label, ())), np.int64)
            on_surface, close = np.isin(mine, surface), np.isin(mine, self.near.get(label, empty))
            others = [other for key, other in self.surface.items() if key != label]
            on_other = np.isin(mine, np.concatenate(others)) if others else np.zeros(len(mine), bool)
            found = np.isin(seen, mine)
            missed = seen[~found]
            elsewhere = np.isin(missed, keys[(labels >= 0) & (labels != label)])
            in_map = np.isin(missed, keys)
            distances = surface_distances(mine, self.shapes[label], self.voxel)
            rows = {
                "predicted": len(mine), "true_predicted": on_surface.sum(),
                "visible": len(seen), "found": found.sum(),
                "false_near": (~on_surface & close).sum(),
                "false_leak": (~on_surface & ~close & on_other).sum(),
                "false_floating": (~on_surface & ~close & ~on_other).sum(),
                "missed_mislabelled": elsewhere.sum(), "missed_unlabelled": (in_map & ~elsewhere).sum(),
                "missed_unmapped": (~in_map).sum(),
                "true_predicted_t1": close.sum(), "found_t1": np.isin(seen, grown(mine)).sum(),
                "accuracy_sum": distances.sum()}
            rows.update({f"precise_{tau}cm": (distances <= tau / 100 + SLACK).sum() for tau in TAUS_CM})
            for metric, value in rows.items():
                self.count(label, metric, value)
        return predicted

    def add_samples(self, points, classes, predicted):
        for label in self.labels:
            mine = points[classes == label]
            distances = cube_distances(mine, predicted[label], self.voxel)
            self.count(label, "samples", len(mine))
            reached = np.isfinite(distances)
            self.count(label, "reached", reached.sum())
            self.count(label, "completeness_sum", distances[reached].sum())
            for tau in TAUS_CM:
                self.count(label, f"complete_{tau}cm", (distances <= tau / 100 + SLACK).sum())

    def rows(self):
        result = []
        for label in self.labels:
            sums = dict(self.sums[label])
            for mean, total, number in (("accuracy_mean_m", sums.pop("accuracy_sum"), sums["predicted"]),
                                        ("completeness_mean_m", sums.pop("completeness_sum"), sums.pop("reached"))):
                result.append((self.names[label], mean, f"{total / number:.9g}" if number else "-"))
            result += [(self.names[label], metric, str(int(value))) for metric, value in sums.items()]
        return sorted(result)


def score(recording, options):
    T_map_world = map_from_world(options.origin_m, np.radians(options.yaw_deg))
    geoms = recording.geoms(T_map_world)
    surface = surface_truth(geoms, options.voxel_m, options.epsilon_m)
    scores = Scores(recording, geoms, surface, options.voxel_m)
    error = np.eye(4)
    error[:3, :3] = exponential(np.radians(options.rotation_deg))
    error[:3, 3] = options.misregistration_m
    believed = error @ recording.T_color_depth
    fused, seen = Map(options.K, max(recording.names) + 1), Samples()
    for frame in recording.frames:
        points, classes = observe(recording, frame, options, believed)
        placed = moved(T_map_world @ frame[3] @ recording.T_base_depth, points)
        hit, labels = winners(voxels_of(placed, options.voxel_m), classes)
        samples, sample_classes = depth_samples(recording, frame, T_map_world)
        keys = voxels_of(samples, options.voxel_m)
        if options.unit == "frame":
            single, alone = Map(options.K, max(recording.names) + 1), Samples()
            single.add(hit, labels)
            alone.add(keys, sample_classes)
            visible = visible_truth(alone, surface, options.min_samples)
            predicted = scores.add_voxels(single.prediction(), visible)
            scores.add_samples(samples, sample_classes, predicted)
        else:
            fused.add(hit, labels)
            seen.add(keys, sample_classes)
    if options.unit == "map":
        predicted = scores.add_voxels(fused.prediction(), visible_truth(seen, surface, options.min_samples))
        for frame in recording.frames:
            scores.add_samples(*depth_samples(recording, frame, T_map_world), predicted)
    return [("class", "metric", "value")] + scores.rows()


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
    rows = (truth_rows if truth_only else score)(recording, options)
    with (sys.stdout if options.output == "-" else open(options.output, "w", encoding="utf-8", newline="")) as text:
        csv.writer(text, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main(sys.argv[1:])
