# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""The truth that a map is held against: surfaces by class and by instance, and what a recording's frames saw of them."""

import numpy as np

from recording import map_from_world, moved
from truth import Samples, key_sets, surface_truth, visible_truth, voxels_of

EMPTY = np.zeros(0, np.int64)
WELL_SEEN = 4  # samples from which on a voxel of V counts for recall_4


def by_class(surfaces, class_of):
    """class -> {key: touch_only} from instance -> {key: touch_only}: a class's surface is that of its instances."""
    result = {}
    for instance, cells in surfaces.items():
        rows = result.setdefault(int(class_of[instance]), {})
        for key, touch_only in cells.items():
            rows[key] = rows.get(key, True) and touch_only
    return result


def lowest_owners(surfaces):
    """label -> keys, all of the surfaces: the owner is the lowest label that the open cube meets, else the lowest, 0 last."""
    best = {}
    for label, cells in surfaces.items():
        for key, touch_only in cells.items():
            rank = (label == 0, touch_only, label)
            best[key] = min(best.get(key, rank), rank)
    owned = {label: [] for label in surfaces}
    for key, (_, _, label) in best.items():
        owned[label].append(key)
    return {label: np.array(sorted(keys), np.int64) for label, keys in owned.items()}


class Lattice:
    """Surfaces on one lattice; made once, since it is what takes time."""

    def __init__(self, recording, voxel=0.05, origin=(0, 0, 0), yaw_deg=0, epsilon=0.0005):
        self.recording, self.voxel, self.origin, self.yaw_deg = recording, voxel, origin, yaw_deg
        self.T_map_world = map_from_world(origin, np.radians(yaw_deg))
        self.geoms = recording.instance_geoms(self.T_map_world)
        self.surfaces = surface_truth(self.geoms, voxel, epsilon)


class Truth:
    """What a map on the lattice is held against.

    frames: numbers of the frames that count, or None for all; scene: all surface counts as seen; geometry: one class.
    """

    def __init__(self, lattice, frames=None, scene=False, geometry=False, min_samples=1):
        recording = lattice.recording
        self.lattice, self.voxel, self.min_samples, self.scene = lattice, lattice.voxel, min_samples, scene
        self.class_of = np.ones_like(recording.class_of) if geometry else recording.class_of
        self.names = {0: "background", 1: "surface"} if geometry else recording.names
        self.detected = [1] if geometry else sorted(recording.detected)
        self.frames = [] if scene else [recording.frames[n] for n in (range(len(recording.frames))
                                                                      if frames is None else frames)]
        surface = by_class(lattice.surfaces, self.class_of)
        self.surface, self.instance_surface = key_sets(surface), key_sets(lattice.surfaces)
        self.shapes = {label: [shape for instance, shape in lattice.geoms if self.class_of[instance] == label]
                       for label in self.names}
        self.any_surface = np.unique(np.concatenate(list(self.surface.values())))
        self.take_samples()
        if scene:
            self.visible, self.instance_visible = lowest_owners(surface), lowest_owners(lattice.surfaces)
        else:
            self.visible, self.instance_visible = self.seen(surface, self.class_of), self.seen(lattice.surfaces, None)
        self.well_seen = self.any_surface if scene else self.sampled_voxels(WELL_SEEN)
        self.visible.pop(0, None)
        self.instance_visible.pop(0, None)

    def take_samples(self):
        """Noise-free samples of the frames in frame map, and the instance of each."""
        recording, points, instances = self.lattice.recording, [np.zeros((0, 3))], [EMPTY]
        for _, depth_path, depth_label_path, T_world_base in self.frames:
            cloud = recording.cloud(recording.read_depth(depth_path))
            valid = cloud[:, 2] > 0
            points.append(moved(self.lattice.T_map_world @ T_world_base @ recording.T_base_depth, cloud[valid]))
            instances.append(recording.read_image(depth_label_path).reshape(-1)[valid])
        self.points, self.instances = np.concatenate(points), np.concatenate(instances)

    def seen(self, surfaces, class_of):
        samples = Samples()
        samples.add(voxels_of(self.points, self.voxel), self.instances if class_of is None else class_of[self.instances])
        return {label: np.array(sorted(cells), np.int64)
                for label, cells in visible_truth(samples, surfaces, self.min_samples).items()}

    def sampled_voxels(self, least=None):
        """Voxels with at least min_samples samples of anything, or with `least`."""
        keys, counts = np.unique(voxels_of(self.points, self.voxel), return_counts=True)
        return keys[counts >= (least or self.min_samples)]

    def s_of(self, label):
        return self.surface.get(label, EMPTY)

    def v_of(self, label):
        return self.visible.get(label, EMPTY)
