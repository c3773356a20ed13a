"""``python3 app`` and ``python3 tests`` on machines that lack something: one clear line each."""

import ast
import os
import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "app"))
import bootstrap  # noqa: E402


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A checkout whose environment is made without downloading anything."""
    (tmp_path / "pyproject.toml").write_text("[project]\nname = 'x'\n")
    for name in ("ARMLAB_VENV", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    made = []

    def install(root, environment, python, extras, anew):
        made.append((tuple(extras), anew))
        python.parent.mkdir(parents=True, exist_ok=True)
        python.touch()

    monkeypatch.setattr(bootstrap, "install", install)
    return tmp_path, made


def test_it_installs_once(checkout):
    root, made = checkout
    first = bootstrap.ensure(root)
    assert bootstrap.ensure(root) == first
    assert made == [((), True)]


def test_more_extras_and_a_changed_project_are_installed_into_the_same_environment(checkout):
    root, made = checkout
    bootstrap.ensure(root)
    bootstrap.ensure(root, ("test",))
    bootstrap.ensure(root)
    (root / "pyproject.toml").write_text("[project]\nname = 'y'\n")
    bootstrap.ensure(root)
    assert made == [((), True), (("test",), False), (("test",), False)]


def test_another_python_makes_it_anew(checkout):
    root, made = checkout
    bootstrap.ensure(root)
    stamp = root / ".venv" / ".armlab"
    stamp.write_text("another\n" + "\n".join(stamp.read_text().split()[1:]))
    bootstrap.ensure(root)
    assert made == [((), True), ((), True)]


def test_an_installation_cut_short_is_done_again(checkout, monkeypatch):
    root, made = checkout
    whole = bootstrap.install

    def cut(*arguments, **options):
        whole(*arguments, **options)
        raise KeyboardInterrupt

    monkeypatch.setattr(bootstrap, "install", cut)
    with pytest.raises(KeyboardInterrupt):
        bootstrap.ensure(root)
    monkeypatch.setattr(bootstrap, "install", whole)
    bootstrap.ensure(root)
    assert len(made) == 2


def test_two_starts_at_once_install_once(checkout):
    root, made = checkout
    starts = [threading.Thread(target=bootstrap.ensure, args=(root,)) for _ in range(4)]
    for start in starts:
        start.start()
    for start in starts:
        start.join()
    assert len(made) == 1


def test_an_old_python_is_told(checkout, monkeypatch):
    monkeypatch.setattr(sys, "version_info", (3, 9, 1))
    with pytest.raises(SystemExit, match=r"^armlab: Python 3\.11 or newer is needed; this is "):
        bootstrap.ensure(checkout[0])


@pytest.mark.parametrize("file", ["app/__main__.py", "app/bootstrap.py", "tests/__main__.py"])
def test_old_pythons_can_read_it(file):
    """What says that Python is too old must parse there; Python 3.6 is what old machines have."""
    ast.parse((ROOT / file).read_text(), feature_version=(3, 6))


def test_what_a_quick_run_leaves_out_is_there():
    text = (ROOT / "tests" / "__main__.py").read_text()
    names = re.search(r'NOT_QUICK = """(.*?)"""', text, re.DOTALL)[1].split()
    assert len(names) > 9
    assert [name for name in names if not list((ROOT / "tests").glob(f"{name}.py" if "test_" in name else name))] == []


def test_a_python_without_venv_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ensurepip", None)
    with pytest.raises(
        SystemExit, match=r"^armlab: this Python has no venv module\..*sudo apt install python3\.\d+-venv"
    ):
        bootstrap.make_environment(tmp_path / "environment")


def pip(tmp_path, text, status):
    """Return a stand-in for the environment's Python that says this and fails."""
    script = tmp_path / "python"
    script.write_text(f"#!/bin/sh\ncat <<'END'\n{text}\nEND\nexit {status}\n")
    script.chmod(0o755)
    return script


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for pip")
@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("WARNING: Failed to establish a new connection", "the packages could not be downloaded; is there a network?"),
        ("noise\nERROR: No matching distribution found for viser", "pip failed: ERROR: No matching distribution"),
        ("something went wrong", "pip failed: something went wrong"),
    ],
)
def test_a_failed_installation_is_one_line(tmp_path, capsys, said, told):
    with pytest.raises(SystemExit) as stop:
        bootstrap.install(tmp_path, tmp_path, pip(tmp_path, said, 1), (), anew=False)
    assert str(stop.value).startswith("armlab: " + told)
    assert "\n" not in str(stop.value)


def test_a_folder_that_cannot_be_written_is_told(checkout, monkeypatch):
    def refuse(*_arguments, **_options):
        raise PermissionError(13, "Permission denied", "/somewhere")

    monkeypatch.setattr(bootstrap, "install", refuse)
    with pytest.raises(SystemExit, match=r"^armlab: cannot write /somewhere; set ARMLAB_VENV"):
        bootstrap.ensure(checkout[0])


def test_a_read_only_checkout_uses_the_cache(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    place = bootstrap.place(ROOT)
    assert place.parent == tmp_path / "armlab"


def test_a_folder_with_other_files_in_it_is_not_emptied(tmp_path, monkeypatch):
    chosen = tmp_path / "documents"
    chosen.mkdir()
    monkeypatch.setenv("ARMLAB_VENV", str(chosen))
    bootstrap.refuse_to_erase(chosen)
    bootstrap.refuse_to_erase(tmp_path / "not there yet")
    (chosen / "thesis.tex").write_text("work")
    with pytest.raises(bootstrap.Problem, match="documents holds other files, which would be lost"):
        bootstrap.ensure(ROOT)
    assert [path.name for path in chosen.iterdir()] == ["thesis.tex"]
    (chosen / ".armlab").write_text("")  # our own, whose installation was cut short
    bootstrap.refuse_to_erase(chosen)


@pytest.fixture
def environment(tmp_path, monkeypatch):
    """An environment that is complete: its Python is that of the tests, and finds the lab as an installed one does."""
    monkeypatch.setenv("ARMLAB_VENV", str(tmp_path / "environment"))
    made = []

    def install(root, environment, python, extras, anew):
        made.append(anew)
        python.parent.mkdir(parents=True)
        used = f'touch "{python}.used"\nPYTHONPATH="{ROOT / "app"}" exec "{sys.executable}" "$@"\n'
        python.write_text(f"#!/bin/sh\n{used}")
        python.chmod(0o755)

    monkeypatch.setattr(bootstrap, "install", install)
    bootstrap.ensure(ROOT)
    assert made == [True]


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for the environment's Python")
def test_the_command_runs_in_the_environment_from_any_folder(environment, tmp_path):
    result = subprocess.run(
        [sys.executable, str(ROOT / "app"), "--version"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("armlab ")
    assert result.stderr == "", "nothing is installed again"
    assert (tmp_path / "environment" / "bin" / "python.used").exists()
