"""The command line, as a real process."""

import gc
import os
import re
import signal
import socket
import urllib.error
import urllib.request
from functools import partial
from pathlib import Path

import pytest

from armlab import cli
from armlab.cli import main
from armlab.content import lessons as library_module
from armlab.content.lessons import Library
from support.command import MAIN, command
from support.patience import WAIT, Patience
from support.student import run, student

NONE = (
    "import armlab.resources as there; real = there.folder; "
    "there.folder = lambda name: real('no_such_folder') if name == 'lessons' else real(name); "
)
"""Code that makes a lab find no lessons; a lab of a process of its own finds them all."""

ALL = ""


def armlab(*arguments, lessons=NONE, **variables):
    """Start the command; without the lab's lessons, which take longer to read than all the rest."""
    return command(*arguments, code=lessons + MAIN, env={**os.environ, **variables})


def opening_lines(process):
    """Return what the command prints until it is open."""
    lines = [process.stdout.readline()]
    while lines[-1] and "Ctrl-C" not in lines[-1]:
        lines.append(process.stdout.readline())
    return lines


@pytest.fixture
def refused(capsys, monkeypatch):
    """Return exit status, output and complaint of a command that ends before a lab is open, in this process."""

    def opened(running, _options):
        running.stop()
        pytest.fail("a lab was opened")

    monkeypatch.setattr(cli, "_run", opened)

    def run(*arguments):
        capsys.readouterr()
        status = main(arguments)
        return status, *capsys.readouterr()

    return run


def end(process, number=signal.SIGINT):
    process.send_signal(number)
    out, err = process.communicate(timeout=WAIT)
    return process.returncode, out, err


def test_it_opens_and_ctrl_c_ends_it_without_a_word(tmp_path):
    process = armlab("--no-browser", "--port", "0", "--state", str(tmp_path), lessons=ALL)
    opens_and_ends_without_a_word(process, signal.SIGINT)


def opens_and_ends_without_a_word(process, number):
    first = process.stdout.readline()
    address = re.fullmatch(r"Armlab is open at (http://127\.0\.0\.1:\d+/)\n", first)
    assert address, first
    assert process.stdout.readline() == "Stop it with Ctrl-C.\n"
    with urllib.request.urlopen(address[1]) as page:
        assert page.status == 200
    status, out, err = end(process, number)
    assert (status, out, err) == (0, "", "")


def test_others_in_the_room_get_an_address_that_works(tmp_path):
    process = armlab("--no-browser", "--host", "0.0.0.0", "--port", "0", "--state", str(tmp_path))
    lines = opening_lines(process)
    others = [re.fullmatch(r"Others in the room type (http://\S+/)\n", line) for line in lines[1:-1]]
    assert all(others), lines
    assert "http://127.0.0.1" in lines[0]
    for other in others:
        assert "0.0.0.0" not in other[1]
        assert "127.0.0.1" not in other[1]
        with urllib.request.urlopen(other[1]) as page:
            assert page.status == 200
    assert end(process)[0] == 0


def test_a_lab_with_a_code_says_it_to_those_who_may_know(tmp_path):
    arguments = ("--no-browser", "--host", "0.0.0.0", "--port", "0", "--code", "blue elbow", "--state", str(tmp_path))
    process = armlab(*arguments)
    own, *others = opening_lines(process)[:-1]
    assert re.fullmatch(r"Armlab is open at http://127\.0\.0\.1:\d+/\?code=blue%20elbow\n", own)
    assert all(line.endswith(" and the code blue elbow\n") for line in others)
    assert end(process)[0] == 0


def test_a_browser_that_cannot_be_opened_is_said_in_one_line(tmp_path):
    process = armlab("--port", "0", "--state", str(tmp_path), BROWSER=str(tmp_path / "missing"), DISPLAY="", PATH="")
    lines = [process.stdout.readline() for _ in range(3)]
    assert re.fullmatch(r"No browser could be opened: open http://127\.0\.0\.1:\d+/ yourself\.\n", lines[2]), lines
    assert end(process)[0] == 0


def test_a_port_in_use_is_one_line(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        process = armlab("--no-browser", "--port", str(port), "--state", str(tmp_path))
        out, err = process.communicate(timeout=WAIT)
    assert (process.returncode, out) == (1, "")
    assert err == f"armlab: port {port} is in use; choose another with --port\n"


def in_use(folder):
    """Return what is to be seen where another lab has the folder."""
    return 1, "", f"armlab: {folder} is in use by another lab; stop that one or choose another with --state DIR\n"


def test_a_lab_keeps_its_folder_even_on_another_port_until_it_is_killed(tmp_path, refused):
    process = armlab("--no-browser", "--port", "0", "--state", str(tmp_path))
    assert process.stdout.readline().startswith("Armlab is open at ")
    assert refused("--no-browser", "--port", "0", "--state", str(tmp_path)) == in_use(tmp_path)
    process.kill()
    process.communicate(timeout=WAIT)
    again = armlab("--no-browser", "--port", "0", "--state", str(tmp_path))
    opens_and_ends_without_a_word(again, signal.SIGTERM)


def test_an_unknown_robot_is_one_line_with_those_there_are(tmp_path, refused):
    status, out, err = refused("--no-browser", "--robot", "puma650", "--state", str(tmp_path))
    assert (status, out) == (1, "")
    assert err.count("\n") == 1
    assert gc.isenabled(), "it is held only while a lab is opened"
    assert "puma650" in err
    assert "puma560" in err


@pytest.mark.parametrize(
    "arguments", [("--port", "70000"), ("--port", "x"), ("--labs", "-1"), ("--code", "abc"), ("--nonsense",)]
)
def test_wrong_options_are_refused(arguments, capsys):
    with pytest.raises(SystemExit) as refused:
        main(arguments)
    out, err = capsys.readouterr()
    assert (refused.value.code, out) == (2, "")
    assert arguments[0] in err


def test_help_names_every_option():
    process = armlab("--help")
    out, _ = process.communicate(timeout=WAIT)
    assert process.returncode == 0
    for option in (
        "--host",
        "--port",
        "--no-browser",
        "--code",
        "--name",
        "--robot",
        "--labs",
        "--lessons",
        "--state",
        "--version",
    ):
        assert option in out


def test_a_class_has_labs_behind_one_front_and_its_folder_for_itself(tmp_path, refused):
    process = armlab("--no-browser", "--port", "0", "--labs", "2", "--state", str(tmp_path))
    address = process.stdout.readline().split()[-1]
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    count, patience = 2 if not children.exists() else 0, Patience()
    while count < 2 and patience.left():  # the page is served before its labs are there
        count = len(children.read_text().split())
    with urllib.request.urlopen(address) as page:
        assert page.status == 200
    assert refused("--no-browser", "--port", "0", "--state", str(tmp_path)) == in_use(tmp_path)
    assert end(process)[0] == 0
    assert count >= 2
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(address)


LESSON = """+++
title = "A lesson of {name}"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
+++
## Only step
Words of {name}.
"""


def fresh_lesson_text(address, name):
    """Return what a new student sees who follows the link to a lesson."""

    async def story():
        browser = await student(address, path=f"/lesson/{name}")
        await browser.until(lambda: f"Words of {name}" in browser.html() or browser.notices)
        seen = browser.html() + "".join(browser.notices)
        await browser.close()
        return seen

    return run(story())


@pytest.mark.parametrize("labs", ["0", "1"])
def test_folders_of_lessons_are_there_for_every_student(tmp_path, labs):
    folders = [tmp_path / "one", tmp_path / "two"]
    for folder in folders:
        folder.mkdir()
        (folder / f"from_{folder.name}.md").write_text(LESSON.format(name=f"from_{folder.name}"))
    chosen = [word for folder in folders for word in ("--lessons", str(folder))]
    process = armlab("--no-browser", "--port", "0", "--labs", labs, "--state", str(tmp_path / "state"), *chosen)
    address = process.stdout.readline().split()[-1]
    for name in ("from_one", "from_two"):
        assert f"Words of {name}" in fresh_lesson_text(address, name)
    status, _, err = end(process)
    assert (status, err) == (0, "")


@pytest.mark.parametrize("labs", ["0", "1"])
def test_a_folder_of_lessons_that_is_not_there_is_one_line(tmp_path, refused, monkeypatch, labs):
    monkeypatch.setattr(library_module, "library", partial(Library, []))
    missing = tmp_path / "missing"
    arguments = ("--no-browser", "--port", "0", "--labs", labs, "--state", str(tmp_path / "state"))
    status, out, err = refused(*arguments, "--lessons", str(tmp_path), "--lessons", str(missing))
    assert (status, out) == (1, "")
    assert err == f"armlab: lessons: expected a folder, got {str(missing)!r}\n"


@pytest.mark.parametrize("where", ["", "sessions"])
@pytest.mark.parametrize("labs", ["0", "1"])
def test_state_that_cannot_be_kept_is_one_line(tmp_path, refused, where, labs):
    file = tmp_path / where if where else tmp_path / "file"
    file.write_text("not a folder")
    status, out, err = refused("--no-browser", "--labs", labs, "--state", str(tmp_path if where else file))
    assert (status, out) == (1, "")
    assert err.count("\n") == 1
    assert "--state" in err
