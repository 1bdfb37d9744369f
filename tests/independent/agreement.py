# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""When a figure that the program prints agrees with the ruler's."""


def agree(metric, ours, theirs):
    if isinstance(theirs, str):
        return ours == theirs
    if theirs is None or ours == "-":
        return theirs is None and ours == "-"
    if isinstance(theirs, int):
        return ours == str(theirs)
    digits = 6 if metric.endswith("_m") else 9
    return abs(float(ours) - theirs) <= 10.0**-digits


def differences(name, ours, theirs):
    lines = []
    for key in sorted(set(ours) | set(theirs)):
        if key not in ours or key not in theirs or not agree(key[1], ours[key], theirs[key]):
            told, expected = ours.get(key, "nothing"), theirs.get(key, "nothing")
            lines.append(f"  {name}: {','.join(key)}: program {told}, ruler {expected}")
    return lines
