# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Records varied homes, trains networks on them, exports, scores them on the unseen home, writes cards.

Called by train.sh, which says what is missing.
"""

import argparse
import dataclasses
import json
import multiprocessing.connection
import pathlib
import sys
import time

import cv2
import torch

import card
import evaluate
import export
import fit
import nets
import recordings
from data import Frames, class_lists

# By the home of the scores: whose variations are trained on, in turn (the home has more rooms than the apartment).
TRAINED_ON = {"cottage": ("apartment", "home", "home"), "home": ("cottage",)}
VALIDATION_SEEDS = range(1000, 1006)
DULL = 0.85
HOMES, FRAMES, STEPS = 96, 20, 4000
QUICK = (3, 12, 40)


@dataclasses.dataclass(frozen=True)
class Data:
    """Frames of training, of held-out variations of the same homes, and of the unseen home."""

    train: Frames
    validation: Frames
    unseen: Frames


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def parser():
    made = Parser(prog="train.sh", description=__doc__)
    add = made.add_argument
    add("--net", choices=[*nets.NETS, "all"], default="all", help="which network [all]")
    add("--seeds", type=int, default=1, help="train with so many seeds [1]")
    add("--first_seed", type=int, default=0, help="first of the seeds [0]")
    size = made.add_mutually_exclusive_group()
    size.add_argument("--steps", type=int, help=f"steps of 8 frames [{STEPS}]")
    size.add_argument("--epochs", type=float, help="times that each frame is seen, in place of --steps")
    size.add_argument("--minutes", type=float, help="processor minutes a network, in place of --steps: the steps "
                                                    "that fit are measured, and then stand in the card")
    size.add_argument("--quick", action="store_true",
                      help="a minute: 3 homes of 12 frames, 40 steps; exit code 1 unless the loss falls")
    add("--unseen", default="cottage", choices=list(TRAINED_ON),
        help="home of the scores; cottage: trained on apartment and home; home: trained on the cottage [cottage]")
    add("--classes", default="nyu13", choices=list(class_lists()), help="list of classes.yaml [nyu13]")
    add("--homes", type=int, help=f"varied homes to record [{HOMES}]")
    add("--frames", type=int, help=f"frames of each [{FRAMES}]")
    add("--threads", type=int, default=2, help="of PyTorch; another number gives other last bits [2]")
    add("--jobs", type=int, default=1, help="networks trained at once, each on --threads [1]")
    add("--program", default=str(recordings.ROOT / "build/release/mapscore"), help="mapscore [build/release]")
    add("--data", default=str(recordings.ROOT / "build/train"), help="folder of recordings, kept [build/train]")
    add("-o", "--output", help="weights and cards [build/weights/UNSEEN]")
    return made


def parsed(argv):
    """Options, checked: wrong ones end in one line and exit code 2."""
    ask = parser()
    args = ask.parse_args(argv)
    if args.quick and (args.homes or args.frames):
        ask.error("--quick sets --homes and --frames; leave them out")
    for key, low in (("seeds", 1), ("first_seed", 0), ("homes", 1), ("frames", 1), ("threads", 1), ("jobs", 1),
                     ("steps", 1)):
        if getattr(args, key) is not None and getattr(args, key) < low:
            ask.error(f"--{key} is {getattr(args, key)}; give {low} or more")
    for key in ("epochs", "minutes"):
        if getattr(args, key) is not None and not 0 < getattr(args, key) < 1e6:
            ask.error(f"--{key} is {getattr(args, key)}; give more than 0")
    if not pathlib.Path(args.program).is_file():
        ask.error(f"there is no program {args.program}; build it (cmake --build --preset release) or name it with "
                  "--program")
    args.output = args.output or str(recordings.ROOT / "build/weights" / args.unseen)
    homes, frames, steps = QUICK if args.quick else (HOMES, FRAMES, STEPS)
    args.homes, args.frames, args.steps = args.homes or homes, args.frames or frames, args.steps or steps
    return args


def gathered(args, fold):
    """Records what is not there yet, and reads it."""
    folder, trained_on = pathlib.Path(args.data), TRAINED_ON[args.unseen]
    homes = [(trained_on[seed % len(trained_on)], seed) for seed in range(args.homes)]
    held_out = [(trained_on[seed % len(trained_on)], seed) for seed in VALIDATION_SEEDS][:1 if args.quick else None]
    made = recordings.varied_all(args.program, homes + held_out, args.frames, folder, args.jobs * args.threads)
    unseen = recordings.drive(args.program, args.unseen, folder, 0.2 if args.quick else 1.4)
    return Data(Frames(made[:len(homes)], fold, DULL), Frames(made[len(homes):], fold), Frames([unseen], fold))


def steps_of(args, name, data, classes):
    if args.minutes:
        return fit.steps_in(name, data.train, classes, 60 * args.minutes)
    if args.epochs:
        return max(1, round(args.epochs * len(data.train) / fit.Recipe.batch))
    return args.steps


def weights_file(args, name, seed):
    return pathlib.Path(args.output) / f"{name}_{args.classes}_{seed}.onnx"


def train(args, name, seed, data, names):
    """One network: weights, card and record."""
    classes, channels = len(names), nets.channels_of(name)
    recipe = fit.Recipe(steps=steps_of(args, name, data, classes))
    began = time.process_time(), time.monotonic()
    net, losses = fit.fit(name, data.train, classes, seed, recipe, lambda text: print(text, flush=True))
    seconds = time.process_time() - began[0], time.monotonic() - began[1]
    file = weights_file(args, name, seed)
    deployed = export.export(net, channels, file, evaluate.images_of(data.unseen, slice(0, 1), channels))
    record = {"net": name, "seed": seed, "classes": args.classes, "threads": args.threads,
              "trained_on": list(dict.fromkeys(TRAINED_ON[args.unseen])), "scored_on": args.unseen,
              "homes": args.homes, "frames": len(data.train),
              "parameters": sum(p.numel() for p in deployed.parameters()),
              "bytes": file.stat().st_size, "steps": recipe.steps,
              "epochs": round(recipe.steps * recipe.batch / len(data.train), 2),
              "processor_s": round(seconds[0], 1), "wall_s": round(seconds[1], 1),
              "loss": [round(sum(part) / len(part), 4) for part in (losses[:10], losses[-10:])]}
    for where, frames in (("validation", data.validation), ("unseen", data.unseen)):
        scored = evaluate.scores(evaluate.confusion(deployed, frames, channels, classes), names)
        record[where] = dataclasses.asdict(scored)
    file.with_suffix(".json").write_text(json.dumps(record, indent=1) + "\n")
    card.write_classes(file.with_suffix(".classes.yaml"), names, class_lists()[args.classes])
    card.write_card(file.with_suffix(".md"), record)
    print(card.row(record), flush=True)


def train_all(args, wanted, data, names):
    """Networks (name, seed), each in a process of its own, `jobs` at once; the frames are shared, not copied."""
    fork, waiting, running = multiprocessing.get_context("fork"), list(wanted), {}
    while waiting or running:
        while waiting and len(running) < args.jobs:
            name, seed = waiting.pop(0)
            process = fork.Process(target=train, args=(args, name, seed, data, names), name=f"{name} seed {seed}",
                                   daemon=True)
            process.start()
            running[process.sentinel] = process
        for ended in multiprocessing.connection.wait(list(running)):
            process = running.pop(ended)
            process.join()
            if process.exitcode:
                raise SystemExit(f"train.sh: {process.name}: failed; see above")


def main(argv):
    args = parsed(argv)
    cv2.setNumThreads(1)
    torch.set_num_threads(args.threads)
    torch.use_deterministic_algorithms(True)
    fold = class_lists()[args.classes]
    names = ["background", *fold]
    pathlib.Path(args.output).mkdir(parents=True, exist_ok=True)
    data = gathered(args, fold)
    print(f"{len(data.train)} frames of {args.homes} varied homes, {len(data.validation)} of held-out ones, "
          f"{len(data.unseen)} of {args.unseen}", flush=True)
    wanted = [(name, seed) for seed in range(args.first_seed, args.first_seed + args.seeds)
              for name in (nets.NETS if args.net == "all" else [args.net])]
    train_all(args, wanted, data, names)
    records = [json.loads(weights_file(args, *n).with_suffix(".json").read_text()) for n in wanted]
    print("\n".join([card.table(records), *card.differences(records)]))
    if args.quick and any(r["loss"][1] >= r["loss"][0] for r in records):
        raise SystemExit("the loss did not fall")


if __name__ == "__main__":
    main(sys.argv[1:])
