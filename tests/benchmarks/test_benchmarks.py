"""Every benchmark still runs, and docs/figures.md is what they write."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[2] / "benchmarks"


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


def report(*arguments, missing=()):
    """Run the command in a process of its own, as if some libraries were not installed."""
    code = (
        "import runpy, sys; "
        f"sys.modules.update(dict.fromkeys({missing!r})); sys.argv[0] = {str(HERE / 'report.py')!r}; "
        f"sys.path[0] = {str(HERE)!r}; runpy.run_path(sys.argv[0], run_name='__main__')"
    )
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)


def filled(name, missing=()):
    """Return the lines of the section after a tiny run."""
    done = report("--tiny", name, missing=missing)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


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
    """Return what does not depend on the machine: heads of tables and what is said around them."""
    heads = [lines[i - 1] for i, line in enumerate(lines) if line.startswith("| ---")]
    said = [line for line in lines if line and not line.startswith(("|", "`python3 "))]
    return heads, " ".join(said).split()


@pytest.mark.parametrize("name", NAMES)
def test_a_benchmark_fills_its_tables_under_its_title_as_in_the_docs(name):
    lines = filled(name)
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
def test_peers_that_are_not_installed_are_left_out(name):
    lines = filled(name, PEERS)
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
def test_what_cannot_be_measured_is_one_line(arguments, says):
    done = report(*arguments)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"benchmarks: {says}\n")
