#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Prints the table of the records (*.json) in a folder of weights, of one list of classes.

    scripts/train/table.py results/weights [nyu13]
"""

import argparse
import json
import pathlib

import card


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("classes", nargs="?", default="nyu13")
    args = parser.parse_args()
    files = sorted(args.folder.glob(f"*_{args.classes}_*.json"))
    if not files:
        parser.exit(2, f"table.py: {args.folder} holds no record *_{args.classes}_*.json; train with --output "
                       f"{args.folder} first\n")
    records = [json.loads(file.read_text()) for file in files]
    print(card.table(records))
    print("\n".join(["", *card.differences(records)]))


if __name__ == "__main__":
    main()
