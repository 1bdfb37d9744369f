# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Runs the program under test as a stranger's machine would, and judges what every run has to keep.

`Program.run` starts it with a PATH that holds the real gnuplot and traps alone. A trap is an executable named like a
command that a hostile name asks for (touch, sh, id, ...); it notes that it was started. What is judged of every run,
whatever it was given:

  - exit code 0, 1 or 2; with 2 exactly one line on standard error, which starts with `mapscore: `
  - standard output and error are UTF-8 without control characters (but line ends and tabs) and without characters that
    change the direction of writing
  - no trap was started, and no file named OWNED... appeared below the work folder
"""

import os
import re
import shutil
import signal
import subprocess
import threading
import unicodedata
from dataclasses import dataclass

TRAPS = ("touch", "sh", "bash", "id", "calc", "cmd", "cat", "ls", "rm", "echo", "curl", "wget", "perl", "python3", "env",
         "xdg-open", "less", "more", "sed", "awk", "date", "true", "sleep", "convert", "mkfifo")
DIRECTIONS = set("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")


def shown(value, most=160):
    """A text or bytes of any kind on one printable line."""
    text = os.fsdecode(value) if isinstance(value, bytes) else str(value)
    text = "".join(c if c.isprintable() and c not in DIRECTIONS else ascii(c)[1:-1] for c in text)
    return text if len(text) <= most else f"{text[:most]}... ({len(text)} characters)"


def what_is_raw(output):
    """What of an output a terminal would obey in place of showing it; None when there is nothing."""
    try:
        text = output.decode("utf-8")
    except UnicodeDecodeError as error:
        return f"is no UTF-8: {shown(output[max(0, error.start - 20):error.start + 8])}"
    for at, letter in enumerate(text):
        if letter not in "\n\t" and (unicodedata.category(letter) in ("Cc", "Zl", "Zp") or letter in DIRECTIONS):
            return f"has a raw {ascii(letter)} after {shown(text[max(0, at - 30):at])!r}"
    return None


@dataclass
class Outcome:
    code: int  # negative: ended by that signal
    out: bytes
    err: bytes

    def complaint(self):
        """What is wrong with how the run ended; None when nothing is."""
        if self.code < 0:
            return f"ended by {signal.Signals(-self.code).name}"
        if self.code not in (0, 1, 2):
            return f"exit code {self.code}"
        lines = self.err.splitlines()
        if self.code == 2 and (self.err.count(b"\n") != 1 or not self.err.startswith(b"mapscore: ")):
            return f"exit code 2 with {len(lines)} lines: {shown(self.err)}"
        return None


class Failures:
    """Lines of what failed, from several threads."""

    def __init__(self):
        self.lines, self.runs, self.refusals, self.lock = [], 0, 0, threading.Lock()

    def add(self, line):
        with self.lock:
            self.lines.append(line)
            print("FAIL", line, flush=True)

    def count(self, outcome):
        with self.lock:
            self.runs += 1
            self.refusals += outcome.code == 2


class Program:
    def __init__(self, path, work, failures):
        self.path, self.work, self.failures = os.path.abspath(path), os.path.abspath(work), failures
        if not os.access(self.path, os.X_OK):
            raise SystemExit(f"{path}: no program there")
        self.traps = os.path.join(self.work, "traps")
        os.makedirs(self.traps, exist_ok=True)
        self.gnuplot, self.beside = shutil.which("gnuplot"), []
        for name in TRAPS:
            file = os.path.join(self.traps, name)
            with open(file, "w", encoding="utf-8") as script:
                script.write(f"#!/bin/sh\necho \"{name} $*\" >> \"$HOME/sprung\"\n")
            os.chmod(file, 0o755)
        if self.gnuplot and not os.path.lexists(os.path.join(self.traps, "gnuplot")):
            os.symlink(os.path.realpath(self.gnuplot), os.path.join(self.traps, "gnuplot"))

    def environment(self, home):
        """Everything that a program may write beside its output goes to `home`, where it is seen."""
        return {"PATH": self.traps, "HOME": home, "TMPDIR": home, "XDG_CACHE_HOME": home, "LC_ALL": "C.UTF-8",
                "MESA_SHADER_CACHE_DISABLE": "true"}  # written outside of the output: docs/security.md

    def start(self, arguments, folder, home=None, before=None, command=()):
        """before: runs in the child ahead of the program; command: stands ahead of it, such as strace."""
        return subprocess.Popen([*command, self.path, *arguments], cwd=folder, env=self.environment(home or folder),
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                preexec_fn=before)

    def wait(self, process, seconds=120):
        try:
            out, err = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            err += f"(killed after {seconds} s)\n".encode()
        outcome = Outcome(process.returncode, out, err)
        self.failures.count(outcome)
        return outcome

    def run(self, arguments, folder, **options):
        return self.wait(self.start(arguments, folder, **options))

    def judge(self, case, outcome):
        """Adds to the failures what no run may do; `case` says which one it was."""
        complaint = outcome.complaint()
        if complaint:
            self.failures.add(f"{case}: {complaint}")
        for name, output in (("standard output", outcome.out), ("standard error", outcome.err)):
            raw = what_is_raw(output)
            if raw:
                self.failures.add(f"{case}: {name} {raw}")

    def judge_traps(self, case, folder, home):
        """Whether something was started or a file made by a name; forgets it, so that it is told once."""
        sprung = os.path.join(home, "sprung")
        if os.path.exists(sprung):
            with open(sprung, encoding="utf-8", errors="replace") as text:
                self.failures.add(f"{case}: a name started: {shown(text.read().strip())}")
            os.remove(sprung)
        for place, folders, files in os.walk(folder):
            for name in folders + files:
                if re.fullmatch(r"OWNED\w*", name):
                    self.failures.add(f"{case}: a name made the file {shown(os.path.join(place, name))}")
                    os.remove(os.path.join(place, name))


def snapshot(folder):
    """{relative path: bytes}; folders and links by their kind."""
    found = {}
    for place, folders, files in os.walk(os.fsencode(folder)):
        for name in folders + files:
            path = os.path.join(place, name)
            key = os.path.relpath(path, os.fsencode(folder))
            if os.path.islink(path):
                found[key] = b"link to " + os.readlink(path)
            elif os.path.isfile(path):
                with open(path, "rb") as file:
                    found[key] = file.read()
    return found
