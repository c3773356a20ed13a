"""Every benchmark still runs, and docs/figures.md is what they write."""

import importlib.util
import json
import re
import subprocess
import sys
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from armlab.content.robots import catalogue

pytestmark = pytest.mark.together

HERE = Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.append(str(HERE))


def loaded(name):
    """Return a file of the benchmarks as a module."""
    spec = importlib.util.spec_from_file_location(f"benchmarks_{name}", HERE / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


figures = loaded("figures")
NAMES = figures.known()
PEERS = ("pinocchio", "numba", "ikpy", "roboticstoolbox", "toppra")
COMPARING = [name for name in NAMES if "\nimport peers\n" in (HERE / f"{name}.py").read_text(encoding="utf-8")]


SERVING = """
import contextlib, io, json, sys, traceback
sys.modules.update(dict.fromkeys({missing!r}))
sys.path[0] = {here!r}
import report
for line in sys.stdin:
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said):
            problem = report.main(["--tiny", line.strip()]) and "refused"
    except Exception:
        problem = traceback.format_exc()
    print(json.dumps([problem, said.getvalue()]), flush=True)
"""
"""Runs one benchmark after the other: libraries are imported once, servers shared."""


class Serving:
    """A process that runs tiny benchmarks, as if some libraries were not installed."""

    def __init__(self, missing=()):
        code = SERVING.format(missing=missing, here=str(HERE))
        command = [sys.executable, "-c", code, "--tiny"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def filled(self, name):
        """Return the lines of the section after a tiny run."""
        print(name, file=self._process.stdin, flush=True)
        answer = self._process.stdout.readline()
        assert answer, "the process has ended"
        problem, said = json.loads(answer)
        assert not problem, problem
        return said.splitlines()

    def end(self):
        """End it and its servers."""
        self._process.stdin.close()
        self._process.stdout.close()
        assert self._process.wait() == 0


@pytest.fixture(scope="module")
def serving():
    process = Serving()
    yield process
    process.end()


@pytest.fixture(scope="module")
def without_peers():
    process = Serving(PEERS)
    yield process
    process.end()


def tables(lines):
    """Return the tables, each a list of rows of cells."""
    found = [[]]
    for line in lines:
        if line.startswith("|"):
            found[-1].append(line.strip("|").split("|"))
        elif found[-1]:
            found.append([])
    return [table for table in found if table]


def skeleton(lines):
    """Return what depends neither on the machine nor on the amount: heads of tables, and words around them."""
    heads = [lines[i - 1] for i, line in enumerate(lines) if line.startswith("| ---")]
    said = [line for line in lines if line and not line.startswith(("|", "`python3 "))]
    return heads, [re.sub(r"\d+", "#", word) for word in " ".join(said).split()]


@pytest.mark.parametrize("name", NAMES)
def test_a_benchmark_fills_its_tables_under_its_title_as_in_the_docs(serving, name):
    lines = serving.filled(name)
    title = re.search(r'^TITLE = "(.*)"', (HERE / f"{name}.py").read_text(encoding="utf-8"), re.MULTILINE)
    assert lines[0] == f"## {title[1]}"
    assert tables(lines)
    for table in tables(lines):
        assert len(table) > 2
        assert {len(row) for row in table} == {len(table[0])}
        assert not any(re.search(r"\b(nan|inf)\b", cell) for row in table[2:] for cell in row[1:])
    if name in (there := figures.sections(figures.FILE.read_text(encoding="utf-8"))):
        assert skeleton(there[name].splitlines()) == skeleton(lines)


@pytest.mark.parametrize("name", COMPARING)
def test_peers_that_are_not_installed_are_left_out(without_peers, name):
    lines = without_peers.filled(name)
    assert tables(lines)
    assert not any(peer in cell for table in tables(lines) for row in table[2:] for cell in row for peer in PEERS)


def test_the_figures_are_sections_of_benchmarks_that_are_there_and_nothing_else():
    text = figures.FILE.read_text(encoding="utf-8")
    found = list(figures.sections(text))
    assert found == [name for name in NAMES if name in found], "python3 benchmarks writes them"
    assert len(found) > len(NAMES) // 2
    assert text == figures.written([text], NAMES)


def test_a_section_takes_the_place_of_the_one_before():
    old = figures.written(
        ["## A\n\n`python3 benchmarks a`, x\n\n| 1 |\n", "## C\n\n`python3 benchmarks c`\n\n| 3 |"], "abc"
    )
    new = figures.written([old, "## B", "", "`python3 benchmarks b`, y", "", "| 2 |"], "abc")
    assert re.findall(r"^## .*|^\| .*", new, re.MULTILINE) == ["## A", "| 1 |", "## B", "| 2 |", "## C", "| 3 |"]
    again = figures.written([new, "## B2", "", "`python3 benchmarks b`, y", "", "| 5 |"], "ab")
    assert re.findall(r"^## .*|^\| .*", again, re.MULTILINE) == ["## A", "| 1 |", "## B2", "| 5 |"]
    assert again.startswith(figures.HEAD)
    assert again == figures.written([again], "ab")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--tiny", "--write", "core"], "figures of --tiny mean nothing and are not written"),
        (["cores"], f"no benchmark 'cores'; there are {', '.join(NAMES)}"),
    ],
)
def test_what_cannot_be_measured_is_one_line(arguments, says, capsys):
    assert loaded("report").main(arguments) == 2
    assert capsys.readouterr() == ("", f"benchmarks: {says}\n")


def test_each_of_several_drags_ends_where_the_arm_was_not():
    drag = loaded("drag")
    ends = [angles[-1] for _, angles in islice(drag.to_and_fro(*drag.script()), 4)]
    # Far more than a drag moves from one event to the next, so that the end of one is no event of another's beginning.
    assert np.abs(np.diff([catalogue()["puma560"].home[0], *ends])).min() > 0.3
