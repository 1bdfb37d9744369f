# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Whether a file that the program wrote is whole and can be read by what reads its kind.

`fault_of(path)` looks at the ending: CSV has as many cells in each row as in the first, none of which a spreadsheet
would run; YAML, JSON and XML parse; PNG and PDF have their ends; PLY, PCD and PGM have as many bytes as their headers
say; a store passes SQLite's own check. It returns what is wrong, or None.
"""

import contextlib
import csv
import io
import json
import os
import re
import shutil
import sqlite3
import tempfile
import xml.etree.ElementTree

import yaml
from PIL import Image

from program import shown

PLY_BYTES = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|[-+]?(inf|nan)|-", re.IGNORECASE)
csv.field_size_limit(10**7)


def csv_fault(data):
    rows = list(csv.reader(io.StringIO(data.decode("utf-8"), newline=""), strict=True))
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            return f"row {number} has {len(row)} cells, the first {len(rows[0])}: {shown(','.join(row))}"
        for cell in row:
            if cell[:1] in ("=", "+", "-", "@", "\t", "\r") and not NUMBER.fullmatch(cell):
                return f"row {number} has a cell that a spreadsheet runs: {shown(cell)}"
    return None


def csv_blocks_fault(data):
    """Of standard output: `#` lines, then one table."""
    lines = data.split(b"\n")
    while lines and lines[0].startswith(b"#"):
        lines.pop(0)
    return csv_fault(b"\n".join(lines))


def png_fault(data):
    if not data.startswith(b"\x89PNG\r\n\x1a\n") or not data.endswith(b"IEND\xaeB`\x82"):
        return f"is cut ({len(data)} bytes)"
    Image.open(io.BytesIO(data)).load()
    return None


def pdf_fault(data):
    whole = data.startswith(b"%PDF-") and data.rstrip().endswith(b"%%EOF")
    return None if whole else f"is cut ({len(data)} bytes)"


def ply_fault(data):
    head, _, body = data.partition(b"end_header\n")
    if b"format binary_little_endian" not in head:
        return None if head else "has no header"
    size, count, properties = 0, 0, []
    for line in head.decode("utf-8").splitlines() + ["element end 0"]:
        words = line.split()
        if words[:1] == ["element"]:
            if "list" in properties:  # one byte of 3, then three indices; here always triangles
                fixed = sum(PLY_BYTES[kind] for kind in properties if kind != "list")
                size += count * (1 + 12 + fixed)
            else:
                size += count * sum(PLY_BYTES[kind] for kind in properties)
            count, properties = int(words[2]), []
        elif words[:1] == ["property"]:
            properties.append(words[1])
    return None if len(body) == size else f"has {len(body)} bytes after the header, which says {size}"


def pcd_fault(data):
    head, _, body = data.partition(b"DATA binary\n")
    fields = {line.split()[0]: line.split()[1:] for line in head.decode("utf-8").splitlines() if line.split()}
    size = int(fields["POINTS"][0]) * sum(map(int, fields["SIZE"]))
    return None if len(body) == size else f"has {len(body)} bytes of points, the header says {size}"


def pgm_fault(data):
    match = re.match(rb"P5\s+(?:#.*\n)*(\d+)\s+(\d+)\s+255\s", data)
    if not match:
        return "has no header"
    size = int(match[1]) * int(match[2])
    return None if len(data) == match.end() + size else f"has {len(data) - match.end()} bytes of {size}"


def store_fault(path):
    """Of a copy with its journal, since looking rolls back what was not finished."""
    with tempfile.TemporaryDirectory() as folder:
        for ending in ("", "-journal", "-wal"):
            if os.path.exists(path + ending):
                shutil.copyfile(path + ending, os.path.join(folder, "copy.sqlite" + ending))
        try:
            with contextlib.closing(sqlite3.connect(os.path.join(folder, "copy.sqlite"))) as store:
                answer = store.execute("pragma integrity_check").fetchall()
        except sqlite3.Error as error:
            return f"SQLite says {error}"
    return None if answer == [("ok",)] else f"integrity_check says {shown(answer)}"


def json_fault(data):
    json.loads(data.decode("utf-8"))


def yaml_fault(data):
    yaml.load(data.decode("utf-8"), getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def xml_fault(data):
    xml.etree.ElementTree.fromstring(data)


READERS = {b".csv": csv_fault, b".png": png_fault, b".pdf": pdf_fault, b".ply": ply_fault, b".pcd": pcd_fault,
           b".pgm": pgm_fault, b".json": json_fault, b".yaml": yaml_fault, b".xml": xml_fault}


def fault_of(name, data, path=None):
    """name: bytes, whose ending says the kind; path: of a store, which SQLite opens itself."""
    try:
        if name.endswith(b".sqlite"):
            return store_fault(path)
        for ending, reader in READERS.items():
            if name.endswith(ending):
                return reader(data)
    except Exception as error:  # pylint: disable=broad-except  # whatever a reader says is the finding
        return f"cannot be read: {type(error).__name__}: {shown(error)}"
    return None
