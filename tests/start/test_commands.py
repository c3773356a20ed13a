"""The commands beside the lab: how they are found, and what a person sees when something goes wrong."""

import io
import os
import signal
from pathlib import Path

import pytest

from armlab import commands
from armlab.commands import CommandType, command_types, run_command
from armlab.errors import InputError
from support.command import command
from support.patience import WAIT


def test_every_command_is_found_by_its_file():
    files = {path.stem for path in Path(commands.__file__).parent.glob("[a-z]*.py")}
    assert set(command_types()) == files
    assert list(command_types()) == ["check", "lesson", "errata", "formulas"]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            ["chekc"],
            "armlab: unknown command 'chekc'; did you mean 'check'? Available: check, errata, formulas, lesson\n",
        ),
        (
            ["lesson", "shet"],
            "armlab lesson: unknown command 'shet'; did you mean 'sheet'? Available: check, new, sheet, words\n",
        ),
        (["xyz"], "armlab: unknown command 'xyz'. Available: check, errata, formulas, lesson\n"),
    ],
)
def test_a_misspelt_command_is_one_line_with_a_proposal(typed, arguments, says):
    assert typed(*arguments) == (2, "", says)


def test_the_help_of_the_lab_lists_all_commands(typed):
    status, out, _ = typed("--help")
    assert status == 0
    for line in (
        "armlab check  ",
        "armlab lesson new ",
        "armlab lesson check ",
        "armlab lesson sheet ",
        "armlab errata ",
    ):
        assert line in out
    assert "--no-browser" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["check"], ["LESSON", "--state", "--format", "--out", "--verbose", "--lessons"]),
        (["lesson", "new"], ["NAME", "--robot", "--to"]),
        (["lesson", "check"], ["LESSON", "--variants", "--lessons"]),
        (["lesson", "sheet"], ["LESSON", "--variants", "--students", "--lessons"]),
        (["errata"], ["ID", "--format", "--seed", "--out"]),
    ],
)
def test_every_command_has_help(typed, arguments, words):
    status, out, _ = typed(*arguments, "--help")
    assert status == 0
    assert f"armlab {' '.join(arguments)}" in out
    assert all(word in out for word in words)


def test_half_a_command_lists_the_rest(typed):
    status, out, err = typed("lesson")
    assert (status, out) == (2, "")
    assert "armlab lesson sheet" in err
    status, out, err = typed("lesson", "--help")
    assert (status, err) == (0, "")
    assert "armlab lesson sheet" in out


@pytest.mark.parametrize(
    ("error", "status", "says"),
    [
        (InputError("a: wrong"), 1, "armlab: a: wrong\n"),
        (PermissionError(13, "Permission denied", "x.json"), 1, "armlab: x.json: Permission denied\n"),
        (OSError("no space"), 1, "armlab: no space\n"),
        (KeyboardInterrupt(), 130, "armlab: stopped\n"),
    ],
)
def test_what_goes_wrong_in_a_command_is_one_line(capsys, error, status, says):
    def fail(options):
        raise error

    assert run_command(["x"], {"x": CommandType("x", 1, "X.", run=fail)}) == status
    assert capsys.readouterr() == ("", says)


@pytest.mark.parametrize(("variables", "written"), [({}, "−30° θ"), ({"PYTHONIOENCODING": "cp1252"}, "?30° ?")])
def test_a_file_gets_the_letters_that_the_machine_has_not(monkeypatch, variables, written):
    monkeypatch.delenv("PYTHONIOENCODING", raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    file = io.BytesIO()
    stream = io.TextIOWrapper(file, encoding="cp1252")
    monkeypatch.setattr("sys.stdout", stream)
    assert run_command(["x"], {"x": CommandType("x", 1, "X.", run=lambda _: print("−30° θ") or 0)}) == 0
    assert file.getvalue().decode(stream.encoding).strip() == written


LOADED = "print(*(name for name in sys.modules if name.split('.')[0] == 'viser' or name.startswith('armlab.commands')))"


def test_commands_load_no_viser_and_need_no_letters_of_the_terminal(work):
    path = work("a.json", student="王")
    code = f"from armlab.cli import main; status = main(sys.argv[1:]); {LOADED}; sys.exit(status)"
    ascii_only = {**os.environ, "PYTHONIOENCODING": "ascii"}
    running = command("check", "mine/v.md", "--state", path, code=code, env=ascii_only)
    out, err = running.communicate(timeout=WAIT)
    assert (running.returncode, err) == (0, "")
    assert out.splitlines()[1].split()[:2] == ["?", "3"]
    assert "viser" not in out.splitlines()[-1].split()
    assert "armlab.commands.check" in out


def test_the_lab_loads_no_commands():
    out, err = command(code=f"import armlab.cli, armlab.front.start; {LOADED}").communicate(timeout=WAIT)
    assert (out.split(), err) == ([], "")


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_ctrl_c_is_one_line(place):
    code = (
        "import time; from armlab import commands; from armlab.cli import main; "
        "wait = lambda options: print('begun', flush=True) or time.sleep(60.0); "
        "commands.command_types = lambda: {'x': commands.CommandType('x', 1, 'X.', run=wait)}; sys.exit(main(['x']))"
    )
    running = command(code=code)
    assert running.stdout.readline() == "begun\n"
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=WAIT)
    assert (running.returncode, out, err) == (130, "", "armlab: stopped\n")


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_reader_that_has_had_enough_is_no_error(place):
    running = command("lesson", "sheet", "mine/v.md", "--variants", "0-299")
    running.stdout.close()
    err = running.stderr.read()
    running.stderr.close()
    running.wait(timeout=WAIT)
    assert err == ""
