#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Runs the generators again; exit 1 and the names of the committed files that differ, if any.

Byte for byte; of PNG files the unpacked rows, since releases of zlib pack differently.
"""

import pathlib
import sys
import tempfile
import zlib

import cottage
import home
import meshes
import textures


def content(path):
    data = path.read_bytes()
    if path.suffix != ".png":
        return data
    head, packed, at = b"", b"", 8
    while at < len(data):
        size = int.from_bytes(data[at : at + 4], "big")
        name, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        head += body if name == b"IHDR" else b""
        packed += body if name == b"IDAT" else b""
        at += 12 + size
    return head + zlib.decompress(packed)


def differing(scenes):
    with tempfile.TemporaryDirectory() as folder:
        again = pathlib.Path(folder)
        meshes.write_all(again / "meshes")
        textures.write_all(again / "textures")
        home.home().write(again)
        cottage.cottage().write(again)
        made = {path.relative_to(again) for path in again.rglob("*") if path.is_file()}
        kept = {
            path.relative_to(scenes)
            for kind in ("meshes", "textures")
            for path in (scenes / kind).iterdir()
        }
        wrong = [path for path in sorted(made) if not (scenes / path).is_file()]
        wrong += [
            path
            for path in sorted(made - set(wrong))
            if content(again / path) != content(scenes / path)
        ]
        return wrong + sorted(kept - made)


if __name__ == "__main__":
    different = differing(pathlib.Path(__file__).resolve().parent.parent)
    for name in different:
        print(
            f"scenes/{name}: is not what the generators write; run scenes/tools/*.py, or mend them"
        )
    sys.exit(1 if different else 0)
