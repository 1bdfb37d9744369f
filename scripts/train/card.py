# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What is written beside a network: its classes, its card, and the table of several."""

import evaluate
from recordings import DRIVES

LIMITS = """\
## Limits

Made to measure how errors of perception reach a map of rendered homes, and for nothing else. It has seen
drawn homes alone: pictures of a real camera are out of its reach. Input is 320 x 240 with a horizontal field
of view of 60 degrees, the camera upright, 0.7 to 1.6 m above the floor, 15 degrees up to 28 down; depth reaches
from 0.6 to 8 m. The furniture's models are the same in all homes, only their looks, places and rooms differ;
so the figures on the unseen home say what a network does in another home of this family, not in any home.
"""


def percent(scores):
    return f"MPA {100 * scores['mpa']:.1f}, MIoU {100 * scores['miou']:.1f}, pixels {100 * scores['pixel_accuracy']:.1f}"


def write_classes(file, names, fold):
    """A file of classes as in docs/foreign_recordings.md, `label` being the channel of the logits."""
    lines = ["# Classes of the network beside this file, by channel of its logits (label); channel 0 is background.",
             "# A class with detect: false is none of the recordings'.", "classes:"]
    for channel, name in enumerate(names[1:], 1):
        own = "" if name in fold[name] else ", detect: false"
        lines.append(f"  - {{name: {name}, label: {channel}{own}}}")
    file.write_text("\n".join(lines) + "\n")


def write_card(file, record):
    """Data, training, figures and limits of one network."""
    name = file.stem
    seen, unseen = record["trained_on"], record["scored_on"]
    shares = "; a third, two thirds" if len(seen) == 2 else ""
    again = (f"scripts/train/train.sh --net {record['net']} --first_seed {record['seed']} --unseen {unseen} "
             f"--classes {record['classes']} --homes {record['homes']} --steps {record['steps']} --threads {record['threads']}")
    lines = [f"# {name}", "",
             f"`{record['net']}` of docs/networks.md, {record['parameters']} parameters, {record['bytes']} bytes, classes "
             f"`{record['classes']}`, seed {record['seed']}.", "", "## Data and training", "",
             f"{record['frames']} frames of {record['homes']} variations of "
             f"{' and '.join(f'scenes/{home}.xml' for home in seen)} (seeds 0 to {record['homes'] - 1}{shares}), seen from "
             f"around the drives of {' and '.join(f'configs/{DRIVES[home]}.yaml' for home in seen)}. "
             f"{record['steps']} steps of 8 frames ({record['epochs']} epochs), {record['processor_s']:.0f} s of "
             f"processor time on {record['threads']} thread(s). Again, with the same bytes on the same machine:", "",
             f"    {again}", "", "## Figures", "",
             f"The {unseen}, drive of configs/{DRIVES[unseen]}.yaml at 1.4 frames a second, not trained on: "
             f"{percent(record['unseen'])}. Held-out variations of the homes of the training: {percent(record['validation'])}.",
             "", f"| class | IoU, {unseen} | accuracy, {unseen} |", "| --- | --- | --- |"]
    for c, iou in record["unseen"]["iou"].items():
        lines.append(f"| {c} | {100 * iou:.1f} | {100 * record['unseen']['accuracy'][c]:.1f} |")
    file.write_text("\n".join(lines) + "\n\n" + LIMITS)


def row(record):
    return (f"{record['net']} seed {record['seed']}: {record['scored_on']} {percent(record['unseen'])}; held-out "
            f"{percent(record['validation'])}; {record['steps']} steps, {record['processor_s']:.0f} s")


def table(records):
    """Means over seeds with Student's 95 % interval, in percent, a line a network."""
    lines = ["| net | seeds | MPA | MIoU | pixels | held-out MIoU | epochs | processor s |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for net in dict.fromkeys(r["net"] for r in records):
        of = [r for r in records if r["net"] == net]
        cells = [evaluate.with_interval([r["unseen"][m] for r in of]) for m in ("mpa", "miou", "pixel_accuracy")]
        cells.append(evaluate.with_interval([r["validation"]["miou"] for r in of]))
        mean = {key: sum(r[key] for r in of) / len(of) for key in ("epochs", "processor_s")}
        lines.append(f"| {net} | {len(of)} | {' | '.join(cells)} | {mean['epochs']:.1f} | {mean['processor_s']:.0f} |")
    return "\n".join(lines)


PAIRS = [("rgbd", "rgb"), ("pspnet", "fcn"), ("cbam_pspnet", "pspnet")]


def differences(records):
    """What the papers order: differences of MIoU seed by seed, mean and 95 % interval; lines."""
    miou = {(r["net"], r["seed"]): r["unseen"]["miou"] for r in records}
    lines = []
    for better, worse in PAIRS:
        seeds = sorted(seed for net, seed in miou if net == better and (worse, seed) in miou)
        if seeds:
            apart = [miou[better, s] - miou[worse, s] for s in seeds]
            lines.append(f"{better} - {worse}: {evaluate.with_interval(apart)} points of MIoU, {len(seeds)} seeds")
    return lines
