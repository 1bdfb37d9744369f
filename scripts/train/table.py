# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Prints the table of the records (*.json) in a folder of weights, of one list of classes.

    scripts/train/table.py results/weights [nyu13]
"""

import json
import pathlib
import sys

import card


def main(folder, classes="nyu13"):
    files = sorted(pathlib.Path(folder).glob(f"*_{classes}_*.json"))
    if not files:
        raise SystemExit(f"{folder} holds no record *_{classes}_*.json; train with --output {folder} first")
    records = [json.loads(file.read_text()) for file in files]
    print(card.table(records))
    print("\n".join(["", *card.differences(records)]))


if __name__ == "__main__":
    main(*sys.argv[1:])
