#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Whether the compiler has made vectors in each function marked MAPSCORE_WIDE_VECTORS.

A loop that it gives up on, for a branch or for arrays that may overlap, gives the same results and no warning, only
more slowly. This looks into the machine code of each function's clones.
"""

import argparse
import pathlib
import re
import subprocess
import sys
from collections import Counter

CLONE = re.compile(r"^[0-9a-f]+ <(.*) \[clone \.arch_x86_64_(v[34])\]>:$")
COMPUTES = re.compile(r"\tv(?!mov|pmov|xor|pxor|zero|broadcast|pbroadcast)\w+ .*%[yz]mm")
MARKED = re.compile(r"^(?:template.*\n)?MAPSCORE_WIDE_VECTORS\s[^;{(]*?(\w+)\(", re.MULTILINE)


def instructions_by_clone(program):
    """How many instructions compute with vectors, by (declaration, architecture)."""
    try:
        listing = subprocess.Popen(["objdump", "-d", "-C", "--no-show-raw-insn", program],
                                   stdout=subprocess.PIPE, text=True)
    except FileNotFoundError:
        sys.exit("objdump is missing: install binutils")
    counts, clone = Counter(), None
    for line in listing.stdout:
        if line.endswith(">:\n"):
            match = CLONE.match(line)
            clone = match.groups() if match else None
            if clone:
                counts[clone] += 0
        elif clone and COMPUTES.search(line):
            counts[clone] += 1
    if listing.wait() != 0:
        sys.exit(f"objdump does not read {program}")
    return counts


def name_of(declaration):
    """`void look_up<float>` of its declaration in the listing."""
    return declaration.replace("(anonymous namespace)::", "").replace("mapscore::", "").split("(")[0]


def marked_functions(root):
    """How many functions of each name are marked."""
    names = Counter()
    for path in root.glob("*/**/*.[ch]pp"):
        if path.relative_to(root).parts[0] in ("core", "eval", "sim", "files"):
            names.update(MARKED.findall(path.read_text()))
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="built by GCC for x86-64, with its symbols")
    parser.add_argument("--list", action="store_true",
                        help="print how many instructions of each clone compute with vectors")
    options = parser.parse_args()
    counts = instructions_by_clone(options.program)
    if options.list:
        for (declaration, architecture), count in sorted(counts.items()):
            print(f"{count:6} {architecture} {name_of(declaration)}")
    marked = marked_functions(pathlib.Path(__file__).resolve().parents[2])
    found = Counter((re.findall(r"\w+", name_of(declaration).split("<")[0])[-1], architecture)
                    for declaration, architecture in counts)
    missing = [f"{name} for {architecture}" for name, count in sorted(marked.items())
               for architecture in ("v3", "v4") if found[name, architecture] < count]
    if missing:
        sys.exit("the program lacks " + ", ".join(missing))
    narrow = [f"{name_of(declaration)} for {architecture}"
              for (declaration, architecture), count in sorted(counts.items())
              if count == 0]
    if narrow:
        sys.exit("no vectors in " + ", ".join(narrow) + ": -fopt-info-vec-missed says why")
    print(f"{len(counts)} clones of {marked.total()} marked functions compute with vectors")


if __name__ == "__main__":
    main()
