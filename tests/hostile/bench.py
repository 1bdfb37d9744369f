# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A case of names.py: a folder `in` that nobody may change, `out` for all that is written, and the runs over them.

`Case.run` starts the program in `in` and judges what it printed; `Case.finish` judges what lies there afterwards:
inputs untouched, every file well-formed, nothing beside `out`, and every gnuplot script that was left draws again
without starting anything. With tracing, each run stands under strace, and nothing but gnuplot may be started.
"""

import os
import re
import shutil
import subprocess
import tempfile

from program import shown, snapshot
from well_formed import csv_blocks_fault, fault_of, json_fault

# Of gnuplot's font library and of the renderer's compiler, kept for all programs of a user.
CACHES_OF_OTHERS = re.compile(rb"(\.cache/)?(fontconfig|gnuplot-wxt)(/|$)|\.cache$")
STRACE = ("/usr/bin/strace", "-f", "--seccomp-bpf", "-qq", "-e", "trace=execve", "-o")


class Case:
    def __init__(self, program, label, must_work=False, traced=False, by_hand=True):
        self.program, self.label, self.must_work, self.traced = program, label, must_work, traced
        self.folder = tempfile.mkdtemp(prefix="case_", dir=os.path.join(program.work, "cases"))
        for name in ("in", "out", "home"):
            os.makedirs(os.path.join(self.folder, name))
        self.by_hand = by_hand  # whether the scripts that are left are drawn once more
        self.home = os.path.join(self.folder, "home")
        self.before, self.ran, self.printed = None, 0, b""

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is None:
            self.finish()
        shutil.rmtree(self.folder, ignore_errors=True)

    def at(self, name):
        """An input's path; bytes where the name is."""
        place = os.path.join(self.folder, "in")
        return os.path.join(os.fsencode(place) if isinstance(name, bytes) else place, name)

    def out(self, name):
        place = os.path.join(self.folder, "out")
        return os.path.join(os.fsencode(place) if isinstance(name, bytes) else place, name)

    def fail(self, text):
        self.program.failures.add(f"{self.label}: {text}")

    def run(self, *arguments, codes=(0,)):
        """Whether the run did what it was asked for. codes: those that mean so."""
        if any(b"\0" in os.fsencode(word) for word in arguments):
            return False  # no command line can hold it
        if self.before is None:
            self.before = snapshot(self.at(""))
        words = " ".join(shown(os.fsencode(word).replace(os.fsencode(self.folder), b"."), 60) for word in arguments)
        trace = os.path.join(self.folder, "trace")
        command = (*STRACE, trace) if self.traced else ()
        self.printed = b""
        outcome = self.program.run(arguments, self.at(""), home=self.home, command=command)
        case = f"{self.label}: {words}"
        self.program.judge(case, outcome)
        self.program.judge_traps(case, self.folder, self.home)
        if self.traced:
            self.judge_trace(case, trace)
        if self.must_work and outcome.code not in codes:
            self.program.failures.add(f"{case}: exit code {outcome.code} for printable names: {shown(outcome.err)}")
        if outcome.code in codes:
            self.judge_output(case, arguments, outcome.out)
        self.printed = outcome.out
        self.ran += 1
        return outcome.code in codes

    def judge_trace(self, case, trace):
        with open(trace, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                match = re.search(r'execve\("((?:[^"\\]|\\.)*)".*= 0$', line)
                ours = match and (match[1] == self.program.path or os.path.basename(match[1]).startswith("gnuplot"))
                if match and not ours:
                    self.program.failures.add(f"{case}: started {shown(line.strip())}")

    def judge_output(self, case, arguments, output):
        fault = None
        try:
            if "csv" in arguments or "--tidy" in arguments:
                fault = csv_blocks_fault(output)
            elif "json" in arguments:
                fault = json_fault(output)
        except Exception as error:  # pylint: disable=broad-except
            fault = f"cannot be read: {type(error).__name__}: {shown(error)}"
        if fault:
            self.program.failures.add(f"{case}: standard output {fault}")

    def draw_again(self):
        """The scripts that lie beside figures are for people to change and run."""
        if not self.program.gnuplot or not self.by_hand:
            return
        for place, _, files in os.walk(os.path.join(self.folder, "out")):
            for name in files:
                if name.endswith(".gp"):
                    subprocess.run([os.path.join(self.program.traps, "gnuplot"), name], cwd=place, check=False,
                                   timeout=60, env=self.program.environment(self.home), stdin=subprocess.DEVNULL,
                                   capture_output=True)
                    self.program.judge_traps(f"{self.label}: gnuplot {shown(name)} by hand", self.folder, self.home)

    def finish(self):
        self.draw_again()
        after = snapshot(self.at(""))
        for name in sorted(set(after) ^ set(self.before or after)):
            self.fail(f"{shown(name)} {'appeared' if name in after else 'is gone'} beside the inputs")
        for name in after:
            if self.before and self.before.get(name, after[name]) != after[name]:
                self.fail(f"the input {shown(name)} was changed")
        for name in snapshot(self.home):
            if not CACHES_OF_OTHERS.match(name):
                self.program.beside.append(f"{shown(name)} of {self.label}")
                break
        extra = set(os.listdir(self.folder)) - {"in", "out", "home", "trace"}
        if extra:
            self.fail(f"{shown(sorted(extra))} appeared beside the output")
        for name, data in snapshot(self.out("")).items():
            fault = fault_of(name, data, os.fsdecode(os.path.join(os.fsencode(self.out("")), name)))
            if fault:
                self.fail(f"{shown(name)} {fault}")
