#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What `mapscore check` tells CI, read as its readers read it, with the hostile names of tests/hostile as classes.

    /usr/bin/python3 -B tests/gate/formats.py build/release/mapscore

JUnit: what Surefire's and Jenkins' schemas ask for and allow. GitHub: workflow commands, by the runner's rules.
"""

import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "hostile"))
import tiny_files  # noqa: E402
from hostile_names import NAMES  # noqa: E402

CI_NAMES = [b"]]><failure/>", b"50%25 %0A::error::x", b"::error::cup", b"a,title=b::c", b"##[error]cup", b"\"'&<>;"]
# element: (required attributes, optional ones, children in their order)
JUNIT = {
    "testsuite": ({"name", "tests", "failures", "errors", "skipped"}, {"time"}, ["properties", "testcase"]),
    "properties": (set(), set(), ["property"]),
    "property": ({"name", "value"}, set(), []),
    "testcase": ({"name", "time"}, {"classname"}, ["error", "failure", "skipped"]),
    "error": ({"type"}, {"message"}, []),
    "failure": ({"type"}, {"message"}, []),
    "skipped": (set(), {"message"}, []),
}


def run(*command, code=0):
    done = subprocess.run(command, capture_output=True, check=False)
    assert done.returncode == code, (command, done.returncode, done.stdout[-500:], done.stderr)
    return done.stdout.decode("utf-8")


def check_element(element):
    required, optional, children = JUNIT[element.tag]
    assert required <= set(element.attrib) <= required | optional, (element.tag, element.attrib)
    places = [children.index(child.tag) for child in element]
    assert places == sorted(places), [child.tag for child in element]
    assert not (element.text or "").strip() and not (element.tail or "").strip()
    for child in element:
        check_element(child)


def check_junit(text, classes, verdict):
    suite = ElementTree.fromstring(text)
    assert suite.tag == "testsuite"
    check_element(suite)
    cases = suite.findall("testcase")
    for attribute, found in (("tests", cases), ("failures", suite.findall(".//failure")),
                             ("errors", suite.findall(".//error")), ("skipped", suite.findall(".//skipped"))):
        assert int(suite.attrib[attribute]) == len(found), attribute
    assert len({(case.attrib["classname"], case.attrib["name"]) for case in cases}) == len(cases), "a case stands twice"
    named = {case.attrib["name"].split(" ", 1)[-1] for case in cases}
    assert set(classes) <= named, set(classes) - named
    assert verdict == "held" or suite.find(f".//{verdict}") is not None, verdict


def workflow_command(line):
    """(command, properties, message) as GitHub's runner takes a line; None for plain text."""
    line = line.lstrip()
    if not line.startswith("::") or "::" not in line[2:]:
        return None
    head, message = line[2:].split("::", 1)
    name, _, properties = head.partition(" ")
    values = dict(pair.split("=", 1) for pair in properties.split(",") if pair)
    for code, letter in (("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
        message = message.replace(code, letter)
    return name, values, message


def check_github(text, classes, fallen):
    commands = [workflow_command(line) for line in text.splitlines()]
    assert commands[-1] is None and "mapscore check" in text.splitlines()[-1]
    assert all(commands[:-1]), text
    for name, values, message in commands[:-1]:
        assert name in ("error", "notice") and values == {"title": "mapscore check"}, (name, values)
        assert "\n" not in message and "\r" not in message, message
    errors = [message for name, _, message in commands[:-1] if name == "error"]
    assert bool(errors) == fallen, text
    for name in classes if fallen else []:
        assert any(f", {name}: " in message for message in errors), (name, text)


def carry(program, folder, names):
    """A gate over crates of these classes: unchanged, fallen (the truth lies elsewhere), not judged."""
    def work(name):
        return os.path.join(folder, name)

    for name in ("before", "after"):
        tiny_files.write_recording(work(name).encode(), names)
        if name == "after":
            with open(work("after/truth/shapes.csv"), "rb") as file:
                shapes = file.read()
            assert b",2.1," in shapes  # where the middles of all crates are
            tiny_files.write(work("after/truth/shapes.csv"), shapes.replace(b",2.1,", b",2.16,"))
        tiny_files.write(work(name + ".yaml"), tiny_files.STUDY % name.encode())
        run(program, "sweep", work(name + ".yaml"), "-o", work("of_" + name), "-q")
    run(program, "sweep", work("before.yaml"), "-o", work("of_other"), "-q", "--set", "seed=9")
    run(program, "sweep", work("before.yaml"), "-o", work("of_coarse"), "-q", "--set", "voxel_m=0.1")
    baseline = work("baseline.json")
    run(program, "check", work("of_before"), "--baseline", baseline, "--update", "--frames")
    classes = [name.decode("utf-8") for name in names]
    for results, code, verdict in (("before", 0, "held"), ("after", 1, "failure"), ("other", 3, "skipped")):
        check = [program, "check", work("of_" + results), "--baseline", baseline, "--any_recording", "--format"]
        check_junit(run(*check, "junit", code=code), classes, verdict)
        check_github(run(*check, "github", code=code), classes, code == 1)
    refused = [program, "check", work("of_coarse"), "--baseline", baseline, "--format"]
    check_junit(run(*refused, "junit", code=2), [], "error")
    assert workflow_command(run(*refused, "github", code=2)) == (
        "error", {"title": "mapscore check"}, "not comparable: voxel_m 0.05 -> 0.1\n")


def main():
    names = [name.text for name in NAMES if name.works] + CI_NAMES
    batches = [names[n:n + 8] for n in range(0, len(names), 8)]
    for batch in batches:
        with tempfile.TemporaryDirectory() as folder:
            carry(os.path.abspath(sys.argv[1]), folder, batch)
    print(f"{len(names)} names in {len(batches)} gates")


if __name__ == "__main__":
    main()
