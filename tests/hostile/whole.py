# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What a run left in a folder, in a form in which two runs of one command line are equal."""

import os
import re

from program import snapshot
from well_formed import fault_of

DATES = re.compile(rb"/(CreationDate|ModDate) ?\([^)]*\)")
STORE = b"results.sqlite"  # its pages may lie in any order; it is compared by what it says


def files_of(place, unsteady=()):
    """{relative path: bytes} without dates, stores and the place's own name. Of unsteady files, which hold measured times,
    only whether they are well-formed."""
    files = {}
    for name, data in snapshot(place).items():
        if os.path.basename(name).startswith(STORE):
            continue
        if name in unsteady:
            files[name] = (fault_of(name, data) or "well-formed").encode()
        else:
            files[name] = DATES.sub(b"", data).replace(os.fsencode(place), b"PLACE")
    return files


def unsteady_files(one, other):
    """Names of the files in which two runs of one command line differ."""
    return {name for name in one if name in other and one[name] != other[name]}
