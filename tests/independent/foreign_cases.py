# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What foreign_maps.py scores: maps in files, the flags of the program, and the figures that the ruler expects."""

import os
from dataclasses import dataclass, field

import numpy as np
import yaml

from damaged_maps import damaged_map, without_free
from free_space import free_space_scores
from instance_scores import instance_scores
from lattice_truth import Lattice, Truth
from map_import import binned, pulled
from map_scores import VoxelMap, best_thresholds, voxel_scores
from point_files import write_csv, write_pcd, write_ply
from recording import transform
from truth import pack, unpack

A = {"voxel": 0.05, "origin": (0.0131, 0.0217, 0.0343), "yaw_deg": 0}
B = {"voxel": 0.0731, "origin": (-0.0233, 0.0107, 0.0071), "yaw_deg": 7.3}
SMALL_TURN = [0.0113, -0.0207, 0.0049, 0.012, -0.009, 0.021, 0.9996670]


@dataclass
class Case:
    name: str
    arguments: list
    expected: dict
    tables: dict = field(default_factory=dict)


def expected_of(voxels, truth, threshold, geometry=False):
    """Rows of the tidy table, and what --details alone tells."""
    result, tables = voxel_scores(voxels, truth, threshold), best_thresholds(voxels, truth)
    if not geometry:
        result.update(instance_scores(voxels, truth, threshold))
    if not voxels.occupied.all() and not truth.scene:
        figures, table = free_space_scores(voxels, truth)
        result.update(figures)
        for row, counts in zip(("occupied", "free"), table):
            tables.update({("truly " + row, column): count for column, count in
                           zip(("occupied", "free", "not in the map"), counts)})
    return result, tables


class Bench:
    """Lattices and truths are kept, since several cases share them."""

    def __init__(self, recording, scene, folder):
        self.recording, self.scene, self.folder, self.lattices = recording, scene, folder, {}

    def path(self, name):
        return os.path.join(self.folder, name)

    def truth(self, lattice, epsilon=0.0005, **options):
        key = lattice["voxel"], lattice["yaw_deg"], epsilon
        if key not in self.lattices:
            self.lattices[key] = Lattice(self.recording, epsilon=epsilon, **lattice)
        return Truth(self.lattices[key], **options)

    def case(self, name, file, lattice, voxels, truth, flags=(), threshold=0.25, geometry=False, source=None):
        expected, tables = expected_of(voxels, truth, 0 if geometry else threshold, geometry)
        arguments = [self.path(file), "--truth", source or self.recording.folder, "--voxel_m", str(lattice["voxel"]),
                     "--origin_m", *map(str, lattice["origin"]), "--yaw_deg", str(lattice["yaw_deg"]), *flags]
        return Case(name, arguments, expected, tables)


def index_columns(voxels):
    return dict(zip("ijk", unpack(voxels.keys).T))


def centres(voxels, edge, kind="f8"):
    return dict(zip("xyz", ((unpack(voxels.keys) + 0.5) * edge).astype(kind).T))


def colours_of(recording, labels):
    return np.array([recording.colours[label] for label in labels.tolist()], np.uint8)


def as_geometry(voxels, p=1.0):
    """Every occupied voxel is surface."""
    return VoxelMap(voxels.keys, voxels.occupied, voxels.occupied.astype(int), np.where(voxels.occupied, p, 0))


def with_p(voxels, p, instances=None):
    return VoxelMap(voxels.keys, voxels.occupied, voxels.labels, p, instances)


def voxel_lists(bench):
    truth = bench.truth(A)
    voxels = without_free(damaged_map(truth, 1, merged=(1, 2), wrong=((4, 2),)))
    names = [truth.names[label] for label in voxels.labels.tolist()]
    write_csv(bench.path("bare.csv"), {**index_columns(voxels), "class": voxels.labels, "probability": voxels.p,
                                       "instance": voxels.instances}, header=False)
    yield bench.case("csv without header, instances", "bare.csv", A, voxels, truth)
    write_csv(bench.path("named.csv"), {"probability": voxels.p, "class": names, **index_columns(voxels)})
    pieces = with_p(voxels, voxels.p)
    yield bench.case("csv by name, pieces", "named.csv", A, pieces, truth)
    yield bench.case("threshold 0.6", "named.csv", A, pieces, truth, ("--threshold", "0.6"), 0.6)
    yield bench.case("geometry of a labelled map", "named.csv", A, as_geometry(pieces, voxels.p), bench.truth(A, geometry=True),
                     ("--geometry",), geometry=True)
    yield bench.case("one frame", "named.csv", A, pieces, bench.truth(A, frames=[2]), ("--frames", "2"))
    yield bench.case("every other frame", "bare.csv", A, voxels, bench.truth(A, frames=[1, 3]), ("--frames", "1::2"))
    yield bench.case("four samples", "named.csv", A, pieces, bench.truth(A, min_samples=4), ("--min_samples", "4"))
    yield bench.case("epsilon 0", "named.csv", A, pieces, bench.truth(A, epsilon=0.0), ("--epsilon_m", "0"))
    yield bench.case("against the scene", "bare.csv", A, voxels, bench.truth(A, scene=True), source=bench.scene)
    write_csv(bench.path("unsure.csv"), {**index_columns(voxels), "class": names})
    yield bench.case("csv without probabilities", "unsure.csv", A, with_p(voxels, np.ones(len(voxels.p))), truth)
    shifted = index_columns(VoxelMap(pack(unpack(voxels.keys) + [3, -2, 5]), None, None, None))
    write_csv(bench.path("shifted.csv"), {**shifted, "class": names, "probability": voxels.p})
    yield bench.case("moved by whole voxels", "shifted.csv", A, pieces, truth, ("--transform", "-0.15 0.1 -0.25 0 0 0 1"))
    turned = pulled(voxels, A["voxel"], transform(SMALL_TURN), A["voxel"])
    yield bench.case("moved by a pose: pulled", "bare.csv", A, turned, truth, ("--transform", " ".join(map(str, SMALL_TURN))))


def point_clouds(bench):
    truth, recording = bench.truth(A), bench.recording
    voxels = without_free(damaged_map(truth, 2, merged=(3,)))
    edge, labels = A["voxel"], voxels.labels
    named = with_p(voxels, voxels.p, voxels.instances)
    write_ply(bench.path("ascii.ply"), {**centres(voxels, edge), "label": labels.astype(np.int32), "nx": voxels.p,
                                        "probability": voxels.p, "object_id": voxels.instances.astype(np.int32)})
    yield bench.case("ply ascii, labels", "ascii.ply", A, named, truth)
    rgb, single = colours_of(recording, labels), voxels.p.astype(np.float32)
    columns = {**centres(voxels, edge, "f4"), **dict(zip(("red", "green", "blue"), rgb.T)), "confidence": single}
    colourful = with_p(voxels, single.astype(float))
    write_ply(bench.path("little.ply"), columns, "binary_little_endian", faces=3)
    yield bench.case("ply little-endian, colours", "little.ply", A, colourful, truth)
    write_ply(bench.path("big.ply"), {"scalar_label": labels.astype(np.float32), **columns,
                                      "instance": voxels.instances.astype(np.int16)}, "binary_big_endian", faces=2)
    yield bench.case("ply big-endian, labels before colours", "big.ply", A, with_p(voxels, single.astype(float),
                                                                                   voxels.instances), truth)
    packed = (rgb.astype(np.uint32) << np.array([16, 8, 0], np.uint32)).sum(axis=1).astype(np.uint32)
    sure = with_p(voxels, np.ones(len(labels)))
    write_pcd(bench.path("ascii.pcd"), {**centres(voxels, edge), "label": labels.astype(np.uint32)})
    yield bench.case("pcd ascii, labels", "ascii.pcd", A, sure, truth)
    write_pcd(bench.path("ros.pcd"), {**centres(voxels, edge, "f4"), "rgb": packed.view(np.float32)}, "binary")
    yield bench.case("pcd binary, packed colours", "ros.pcd", A, sure, truth)
    yield from crowded(bench, truth, voxels)
    with open(bench.path("legend.yaml"), "w", encoding="utf-8") as text:
        yaml.safe_dump({"ids": {-label - 1: name for label, name in truth.names.items()}}, text)
    write_pcd(bench.path("negative.pcd"), {**centres(voxels, edge, "f4"), "label": (-labels - 1).astype(np.int32),
                                           "score": single}, "binary_compressed")
    yield bench.case("pcd compressed, legend", "negative.pcd", A, colourful, truth, ("--legend", bench.path("legend.yaml")))


def crowded(bench, truth, voxels):
    """Several points a voxel that disagree, placed at random in it; then the same cloud in another frame."""
    random, edge = np.random.default_rng(3), A["voxel"]
    rows = np.repeat(np.arange(len(voxels.keys)), random.integers(1, 7, len(voxels.keys)))
    labels = np.where(random.uniform(size=len(rows)) < 0.4, random.integers(0, max(truth.names) + 1, len(rows)),
                      voxels.labels[rows])
    p = random.integers(0, 1001, len(rows)) / 1000
    instances = np.maximum(0, voxels.instances[rows] + random.integers(-1, 2, len(rows)))
    points = (unpack(voxels.keys[rows]) + random.uniform(0.001, 0.999, (len(rows), 3))) * edge
    columns = {"label": labels.astype(np.uint16), "probability": p, "instance": instances.astype(np.uint32)}
    write_pcd(bench.path("crowd.pcd"), {**dict(zip("xyz", points.T)), **columns}, "binary_compressed")
    mixed = binned(points, labels, p, instances, edge)
    yield bench.case("pcd compressed, points that disagree", "crowd.pcd", A, mixed, truth)
    T = transform(SMALL_TURN)
    away = (points - T[:3, 3]) @ T[:3, :3]
    write_csv(bench.path("away.csv"), {"class": labels, **dict(zip("xyz", away.T)), "probability": p})
    with open(bench.path("matrix.txt"), "w", encoding="utf-8") as text:
        text.write("# T_map_file\n" + "\n".join(", ".join(map(repr, row)) for row in T.tolist()))
    yield bench.case("points moved by a matrix", "away.csv", A, with_p(mixed, mixed.p), truth,
                     ("--transform", bench.path("matrix.txt")))
    far = bench.truth(B)
    write_ply(bench.path("crowd.ply"), {**dict(zip("xyz", points.T)), **columns}, "binary_little_endian")
    yield bench.case("points on another lattice", "crowd.ply", B, binned(points, labels, p, instances, B["voxel"]), far,
                     ("--trust_frame",))
