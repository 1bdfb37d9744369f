# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes OctoMap's octree files, .ot and .bt, from voxels by index, and reads our own .ot; written from the format alone.

A tree has 16 levels; the finest voxel i has key i + 32768; bit n of a child's number tells the half on axis n. Eight equal
leaves of one parent become one leaf, as OctoMap prunes them.
"""

import struct

import numpy as np

from truth import pack

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


class SemanticTree:
    """A SemanticOcTree file: .voxels is key -> (log-odds, {class: weight}), pruned leaves as the voxels that they cover."""

    def __init__(self, path):
        with open(path, "rb") as file:
            head, self.bytes = file.read().split(b"\ndata\n", 1)
        if b"\nid SemanticOcTree\n" not in head:
            raise ValueError(f"{path}: no SemanticOcTree")
        self.at, codes, payloads = 0, [], []
        for code, levels, payload in self.leaves(0, LEVELS):
            codes.append(code + np.arange(8**levels))
            payloads += [payload] * 8**levels
        if self.at != len(self.bytes):
            raise ValueError(f"{path}: {len(self.bytes) - self.at} bytes behind the last node")
        self.voxels = dict(zip(pack(separated(np.concatenate(codes))).tolist(), payloads))

    def take(self, kind):
        self.at += struct.calcsize(kind)
        return struct.unpack_from(kind, self.bytes, self.at - struct.calcsize(kind))

    def leaves(self, code, levels):
        """Number in depth-first order, levels below and payload of each leaf."""
        log_odds, n = self.take("<fH")
        weights = dict(self.take("<Hd") for _ in range(n & 0x7fff))
        if n & 0x8000:  # a mean colour
            self.take("<4I")
        children, = self.take("<B")
        if children == 0:
            yield code << 3 * levels, levels, (log_odds, weights)
        for child in range(8):
            if children >> child & 1:
                yield from self.leaves(code << 3 | child, levels - 1)


def separated(code):
    """Index of each voxel from its number in depth-first order."""
    keys = np.zeros((len(code), 3), np.int64)
    for bit in range(LEVELS):
        for axis in range(3):
            keys[:, axis] |= (code >> (3 * bit + axis) & 1) << bit
    return keys - MIDDLE
