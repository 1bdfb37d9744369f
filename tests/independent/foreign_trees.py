# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""More of what foreign_maps.py scores: octrees, voxels of another size, label images."""

import numpy as np

from damaged_maps import damaged_map
from foreign_cases import SMALL_TURN, A, B, Case, as_geometry, colours_of, with_p
from label_scores import label_scores, write_labels
from map_import import pulled, pushed
from map_scores import VoxelMap
from octree_files import colour_payloads, plain_payloads, semantic_payloads, write_octree
from recording import transform
from truth import pack, unpack


CLAMP = 0.971  # OctoMap's upper clamp of an occupancy


def with_blocks(voxels, share=3):
    """Here and there eight voxels of one parent are made equal, so that the tree can be pruned."""
    rows = dict(zip(voxels.keys.tolist(), range(len(voxels.keys))))
    parents = np.unique(unpack(voxels.keys) // 2, axis=0)
    for parent in parents[parents.sum(axis=1) % share == 0]:
        members = pack(2 * parent + np.array(list(np.ndindex(2, 2, 2)))).tolist()
        rows.update(dict.fromkeys(members, next(rows[key] for key in members if key in rows)))
    keys = np.array(sorted(rows), np.int64)
    order = np.array([rows[key] for key in keys.tolist()])
    return VoxelMap(keys, voxels.occupied[order], voxels.labels[order], voxels.p[order], voxels.instances[order])


def log_odds(voxels):
    """Some value on the right side of zero for every voxel, zero itself occupied, as float32."""
    size = np.float32(0.25) * (1 + voxels.labels % 5) + (voxels.p * 2).astype(np.float32)
    return np.where(voxels.occupied, np.where(voxels.labels == 4, 0, size), -size - np.float32(0.01)).astype(np.float32)


def occupancy(values):
    return 1 / (1 + np.exp(-values.astype(float)))


def class_lists(voxels):
    """The class of each voxel with its probability, and others behind it; a tie goes to the lower class."""
    result = []
    for n, (label, p, occupied) in enumerate(zip(voxels.labels.tolist(), voxels.p.tolist(), voxels.occupied)):
        rows = [(label, p)] if label and occupied else []
        if rows and n % 3 == 0:
            rows.append((label + 2, p if n % 2 else p / 2))
        if rows and label > 1 and p > 0 and n % 4 == 0:
            rows.append((label - 1, p * 0.75))
        result.append(rows)
    return result


def write_semantic(path, edge, voxels):
    write_octree(path, "SemanticOcTree", edge, unpack(voxels.keys), semantic_payloads(log_odds(voxels), class_lists(voxels)))


def known(voxels):
    """As a tree holds them: a class of probability 0 is none; weights that add up to more than 1.5 are counts."""
    totals = np.array([sum(weight for _, weight in rows) for rows in class_lists(voxels)])
    p = np.where(totals > 1.5, voxels.p / np.maximum(totals, 1), voxels.p)
    return VoxelMap(voxels.keys, voxels.occupied, np.where(voxels.p > 0, voxels.labels, 0), p, voxels.instances)


def trees(bench):
    truth, solid = bench.truth(A), bench.truth(A, geometry=True)
    voxels = with_blocks(damaged_map(truth, 5, merged=(1, 2), wrong=((8, 1),)))
    indices, values = unpack(voxels.keys), log_odds(voxels)
    write_semantic(bench.path("semantic.ot"), A["voxel"], voxels)
    pieces = with_p(known(voxels), known(voxels).p)
    yield bench.case("SemanticOcTree with free voxels", "semantic.ot", A, pieces, truth)
    yield bench.case("free space of two frames", "semantic.ot", A, pieces, bench.truth(A, frames=[0, 3], min_samples=2),
                     ("--frames", "0,3", "--min_samples", "2"))
    colours = colours_of(bench.recording, voxels.labels)
    write_octree(bench.path("colour.ot"), "ColorOcTree", A["voxel"], indices, colour_payloads(values, colours.tolist()))
    yield bench.case("ColorOcTree", "colour.ot", A, with_p(voxels, occupancy(values)), truth)
    write_octree(bench.path("plain.ot"), "OcTree", A["voxel"], indices, plain_payloads(values))
    yield bench.case("OcTree, geometry", "plain.ot", A, as_geometry(voxels, occupancy(values)), solid, geometry=True)
    write_octree(bench.path("binary.bt"), "OcTree", A["voxel"], indices, voxels.occupied.tolist(), binary=True)
    sure = as_geometry(voxels, occupancy(np.log([CLAMP / (1 - CLAMP)]).astype(np.float32))[0])
    yield bench.case("binary OcTree, geometry", "binary.bt", A, sure, solid, geometry=True)
    yield bench.case("binary OcTree against the scene", "binary.bt", A, sure, bench.truth(A, geometry=True, scene=True),
                     geometry=True, source=bench.scene)
    far = bench.truth(B)
    voxels = with_blocks(damaged_map(far, 6, merged=(2,)))
    write_semantic(bench.path("far.ot"), B["voxel"], voxels)
    yield bench.case("another voxel size, origin and yaw", "far.ot", B, with_p(known(voxels), known(voxels).p), far)


def resampled(bench):
    """Voxels of another size than the truth's, or moved."""
    truth, none = bench.truth(A), np.eye(4)
    coarse = bench.truth({"voxel": 0.1, "origin": A["origin"], "yaw_deg": 0})
    large = damaged_map(coarse, 7)
    write_semantic(bench.path("large.ot"), 0.1, large)
    pulled_voxels = pulled(known(large), 0.1, none, A["voxel"])
    yield bench.case("coarser voxels, pulled", "large.ot", A, with_p(pulled_voxels, pulled_voxels.p), truth, ("--resample",))
    turn = transform(SMALL_TURN)
    flags = ("--resample", "--transform", " ".join(map(str, SMALL_TURN)))
    pulled_voxels = pulled(known(large), 0.1, turn, A["voxel"])
    yield bench.case("coarser voxels, moved", "large.ot", A, with_p(pulled_voxels, pulled_voxels.p), truth, flags)
    small = damaged_map(truth, 8)
    write_semantic(bench.path("small.ot"), A["voxel"], small)
    for name, matrix, more in (("finer voxels, pushed", none, ("--resample",)), ("finer voxels, moved", turn, flags)):
        pushed_voxels = pushed(known(small), A["voxel"], matrix, B["voxel"])
        yield bench.case(name, "small.ot", B, with_p(pushed_voxels, pushed_voxels.p), bench.truth(B),
                         (*more, "--trust_frame"))
    pulled_voxels = pulled(known(small), A["voxel"], turn, A["voxel"])
    yield bench.case("voxels of the same size, moved", "small.ot", A, with_p(pulled_voxels, pulled_voxels.p), truth,
                     flags[1:])


def label_folders(bench):
    recording, random = bench.recording, np.random.default_rng(9)
    for name, palette, frames, flags in (("grey", False, range(len(recording.frames)), ()),
                                         ("palette", True, [1, 2], ("--frames", "1:3"))):
        folder = bench.path("labels_" + name)
        write_labels(folder, recording, random, palette)
        yield Case(f"label images, {name}", [folder, "--truth", recording.folder, *flags],
                   label_scores(folder, recording, frames))
