# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes OctoMap's octree files, .ot and .bt, from voxels by index; written from the format alone.

A tree has 16 levels; the finest voxel i has key i + 32768; bit n of a child's number tells the half on axis n. Eight equal
leaves of one parent become one leaf, as OctoMap prunes them.
"""

import struct

import numpy as np

LEVELS, MIDDLE = 16, 32768


def interleaved(indices):
    """Number of each voxel in depth-first order."""
    keys = np.asarray(indices, np.int64) + MIDDLE
    code = np.zeros(len(keys), np.int64)
    for bit in range(LEVELS):
        for axis in range(3):
            code |= (keys[:, axis] >> bit & 1) << (3 * bit + axis)
    return code


def tree_of(indices, payloads):
    """Nested lists of eight children (None where unknown) with payloads as leaves, pruned bottom-up."""
    level = dict(zip(interleaved(indices).tolist(), payloads))
    for _ in range(LEVELS):
        parents = {}
        for code, node in level.items():
            parents.setdefault(code >> 3, [None] * 8)[code & 7] = node
        level = {code: pruned(children) for code, children in parents.items()}
    return level[0]


def pruned(children):
    first = children[0]
    return first if not isinstance(first, list) and first is not None and children.count(first) == 8 else children


def count_nodes(node):
    return 1 + sum(count_nodes(child) for child in node if child is not None) if isinstance(node, list) else 1


def some_payload(node):
    """Inner nodes repeat one of their leaves; readers have to look at the leaves alone."""
    while isinstance(node, list):
        node = next(child for child in node if child is not None)
    return node


def full_nodes(node):
    payload = some_payload(node)
    children = node if isinstance(node, list) else [None] * 8
    yield payload + bytes([sum(1 << n for n, child in enumerate(children) if child is not None)])
    for child in children:
        if child is not None:
            yield from full_nodes(child)


def binary_nodes(node):
    """Two bits a child: 0 unknown, 1 free leaf, 2 occupied leaf, 3 inner node."""
    kinds = [0 if child is None else 3 if isinstance(child, list) else 1 + child for child in node]
    yield struct.pack("<H", sum(kind << 2 * n for n, kind in enumerate(kinds)))
    for child in node:
        if isinstance(child, list):
            yield from binary_nodes(child)


def write_octree(path, kind, edge, indices, payloads, binary=False):
    """payloads: bytes of each node before its byte of children, or for a binary tree whether it is occupied."""
    tree = tree_of(indices, payloads)
    what = "OcTree binary file" if binary else "OcTree file"
    head = (f"# Octomap {what}\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
            f"id {kind}\nsize {count_nodes(tree)}\nres {edge!r}\ndata\n")
    with open(path, "wb") as out:
        out.write(head.encode())
        out.write(b"".join((binary_nodes if binary else full_nodes)(tree)))


def plain_payloads(log_odds):
    return [struct.pack("<f", value) for value in log_odds]


def colour_payloads(log_odds, colours):
    return [struct.pack("<f3B", value, *colour) for value, colour in zip(log_odds, colours)]


def semantic_payloads(log_odds, classes):
    """classes: of each voxel a list of (class, probability)."""
    return [struct.pack("<fH", value, len(rows)) + b"".join(struct.pack("<Hd", *row) for row in sorted(rows))
            for value, rows in zip(log_odds, classes)]
