# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes point clouds and voxel lists: .ply and .pcd in all their encodings, .csv; reads binary .pcd.

Columns are numpy arrays by field name.
"""

import csv
import struct

import numpy as np

PLY_TYPES = {"f4": "float", "f8": "double", "u1": "uchar", "i1": "char", "u2": "ushort", "i2": "short", "u4": "uint",
             "i4": "int"}


def records_of(columns, order="<"):
    """One packed structure a point."""
    kinds = [(name, order + column.dtype.str[1:]) for name, column in columns.items()]
    result = np.zeros(len(next(iter(columns.values()))), kinds)
    for name, column in columns.items():
        result[name] = column
    return result


def text_rows(columns):
    """Numbers as the shortest texts that read back as the same values."""
    return zip(*([repr(value) for value in column.tolist()] for column in columns.values()))


def write_ply(path, columns, encoding="ascii", faces=0):
    """encoding: ascii, binary_little_endian or binary_big_endian; some triangles after the points are to be passed over."""
    count = len(next(iter(columns.values())))
    head = ["ply", f"format {encoding} 1.0", "comment points of a test", f"element vertex {count}"]
    head += [f"property {PLY_TYPES[column.dtype.str[1:]]} {name}" for name, column in columns.items()]
    if faces:
        head += [f"element face {faces}", "property list uchar int vertex_indices"]
    order = ">" if encoding == "binary_big_endian" else "<"
    with open(path, "wb") as out:
        out.write(("\n".join(head) + "\nend_header\n").encode())
        if encoding == "ascii":
            out.write("".join(" ".join(row) + "\n" for row in text_rows(columns)).encode())
            out.write(b"3 0 0 0\n" * faces)
        else:
            out.write(records_of(columns, order).tobytes())
            out.write(struct.pack(order + "Biii", 3, 0, 0, 0) * faces)


def lzf_compressed(data):
    """LZF: runs of up to 32 literals, and references to three bytes or more seen at most 8192 bytes before."""
    out, literals, seen, at = bytearray(), bytearray(), {}, 0

    def flush():
        for begin in range(0, len(literals), 32):
            part = literals[begin:begin + 32]
            out.append(len(part) - 1)
            out.extend(part)
        literals.clear()

    while at < len(data):
        here = data[at:at + 3]
        before = seen.get(here, -1)
        seen[here] = at
        if len(here) < 3 or before < 0 or at - before > 8192:
            literals.append(data[at])
            at += 1
            continue
        length = 3
        while length < 264 and at + length < len(data) and data[before + length] == data[at + length]:
            length += 1
        flush()
        back = at - before - 1
        if length < 9:
            out.append((length - 2) << 5 | back >> 8)
        else:
            out.extend((7 << 5 | back >> 8, length - 9))
        out.append(back & 255)
        at += length
    flush()
    return bytes(out)


def write_pcd(path, columns, encoding="ascii"):
    """encoding: ascii, binary or binary_compressed (field by field, LZF)."""
    count = len(next(iter(columns.values())))
    types = [column.dtype for column in columns.values()]
    head = ["# .PCD v0.7 - Point Cloud Data file format", "VERSION 0.7", "FIELDS " + " ".join(columns),
            "SIZE " + " ".join(str(kind.itemsize) for kind in types),
            "TYPE " + " ".join({"f": "F", "u": "U", "i": "I"}[kind.kind] for kind in types),
            "COUNT " + " ".join("1" for _ in types), f"WIDTH {count}", "HEIGHT 1", "VIEWPOINT 0.1 0.2 0.3 1 0 0 0",
            f"POINTS {count}", f"DATA {encoding}"]
    with open(path, "wb") as out:
        out.write(("\n".join(head) + "\n").encode())
        if encoding == "ascii":
            out.write("".join(" ".join(row) + "\n" for row in text_rows(columns)).encode())
        elif encoding == "binary":
            out.write(records_of(columns).tobytes())
        else:
            plain = b"".join(column.astype(column.dtype.newbyteorder("<")).tobytes() for column in columns.values())
            packed = lzf_compressed(plain)
            out.write(struct.pack("<II", len(packed), len(plain)) + packed)


def read_pcd(path):
    """A structure a point, of a binary file whose fields have one value each."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"\nDATA binary\n", 1)
    lines = dict(line.split(" ", 1) for line in head.decode().splitlines() if not line.startswith("#"))
    kinds = [(name, f"<{kind.lower()}{size}") for name, kind, size in
             zip(*(lines[key].split() for key in ("FIELDS", "TYPE", "SIZE")))]
    return np.frombuffer(data, kinds, count=int(lines["POINTS"]))


def write_csv(path, columns, header=True):
    """Columns may also be lists of texts."""
    texts = [column if isinstance(column, list) else [text for (text,) in text_rows({"": column})]
             for column in columns.values()]
    with open(path, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        if header:
            writer.writerow(columns)
        writer.writerows(zip(*texts))
