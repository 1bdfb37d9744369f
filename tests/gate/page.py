#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Runs what docs/ci.md tells people to copy: the first commands, the workflow's steps, the CTest recipe.

    /usr/bin/python3 -B tests/gate/page.py build/release/mapscore build/release/mapscore_mutant FOLDER

Everything is taken from the page as it stands; the gate is configs/gate.yaml. Then the program is exchanged for one
that is wrong, and workflow and CTest have to fail. The workflow's step Build is left to scripts/test.sh.
"""

import os
import re
import shutil
import subprocess
import sys

import yaml

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.MULTILINE | re.DOTALL)


class Project:
    """A repository with gate.yaml in its root, and a program in its path and its build folder."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(os.path.join(self.folder, "build", "release"))
        self.program = os.path.join(self.folder, "build", "release", "mapscore")
        with open(os.path.join(SOURCE, "configs", "gate.yaml"), encoding="utf-8") as file:
            gate = file.read()
        assert "scene: ../scenes/" in gate
        scenes = os.path.realpath(os.path.join(SOURCE, "scenes"))
        self.write("gate.yaml", gate.replace("../scenes", scenes))

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def use(self, program):
        if os.path.lexists(self.program):
            os.remove(self.program)
        os.symlink(os.path.abspath(program), self.program)

    def shell(self, script, code=0):
        path = os.path.dirname(self.program) + os.pathsep + os.environ["PATH"]
        summary = os.path.join(self.folder, "summary.md")
        done = subprocess.run(["bash", "-e", "-c", script], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": path, "GITHUB_STEP_SUMMARY": summary})
        assert done.returncode == code, (script, done.returncode, done.stdout, done.stderr)
        return done.stdout


def run_workflow(project, workflow, falls):
    """As the runner does: a step that fails ends the job, but for those with `if: always()`."""
    failed = []
    for step in workflow["jobs"]["gate"]["steps"]:
        if "run" not in step or step["name"] == "Build" or (failed and step.get("if") != "always()"):
            continue
        code = 1 if falls and step["name"] == "Check" else 0
        out = project.shell(step["run"], code)
        if code:
            failed.append(step["name"])
        if step["name"] == "Check":
            assert ("::error title=mapscore check::" in out) == falls, out
    with open(os.path.join(project.folder, "summary.md"), encoding="utf-8") as file:
        assert ("| worse |" in file.read()) == falls
    os.remove(os.path.join(project.folder, "summary.md"))
    assert bool(failed) == falls


def main():
    right, wrong, folder = sys.argv[1:4]
    with open(os.path.join(SOURCE, "docs", "ci.md"), encoding="utf-8") as file:
        page = file.read()
    project = Project(folder)
    project.use(right)
    first = [line.strip() for line in re.findall(r"^    mapscore .*", page, re.MULTILINE)][:3]
    assert [line.split()[1] for line in first] == ["sweep", "check", "check"], first
    for line in first:
        project.shell(line)

    [workflow] = [yaml.safe_load(text) for text in blocks(page, "yaml")]
    project.use(right)
    run_workflow(project, workflow, False)
    project.use(wrong)
    run_workflow(project, workflow, True)

    recipes = blocks(page, "cmake")
    assert len(recipes) == 2, len(recipes)
    project.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.22)\nproject(gate NONE)\nenable_testing()\n" +
                  "".join(recipes))
    project.use(right)
    configure, test = "cmake -S . -B build/cmake", "ctest --test-dir build/cmake --output-on-failure"
    project.shell(configure)
    assert "100% tests passed, 0 tests failed out of 2" in project.shell(test)
    project.use(wrong)
    assert re.search(r"gate\.check .*Failed", project.shell(test, 8))
    project.shell("cmake --build build/cmake --target gate_update")
    assert "100% tests passed" in project.shell(test)
    print("the commands, the workflow and the recipe of docs/ci.md pass, and fail with a core that is wrong")


if __name__ == "__main__":
    main()
