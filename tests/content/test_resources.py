"""Data are found in a checkout and in a wheel."""

import subprocess
import sys
import zipfile

import pytest

from armlab import resources

MOST_BYTES = 4_000_000
"""The code of the lab and its lessons are some 3.2 million; what comes along by mistake is larger than the rest."""


def test_a_checkout_reads_its_own_folders():
    top = resources.checkout()
    assert top is not None
    assert resources.folder("robots") == top / "robots"


def test_a_folder_that_is_not_there_has_no_files():
    assert resources.files("nothing", ".toml") == []


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, built from the checkout."""
    out = tmp_path_factory.mktemp("wheel")
    top = resources.checkout()
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(out), str(top)]
    subprocess.run(command, check=True, capture_output=True)
    return next(out.glob("*.whl"))


def test_the_wheel_holds_the_data_and_is_small(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    for file in ("_data/robots/puma560.toml", "front/static/armlab.js", "front/static/armlab.css", "py.typed"):
        assert f"armlab/{file}" in names
    assert wheel.stat().st_size < MOST_BYTES


def test_the_wheel_holds_only_what_the_lab_reads_and_nothing_twice(wheel):
    """No pictures of the docs, no compiled files, no copy of the data."""
    with zipfile.ZipFile(wheel) as files:
        own = [name for name in files.namelist() if name.startswith("armlab/")]
        assert {name.rpartition(".")[2] for name in own} <= {"py", "typed", "js", "css", "md", "toml", "svg", "po"}
        contents = [data for name in own if len(data := files.read(name)) > 100]
    assert len(contents) == len(set(contents))


def test_an_installed_wheel_loads_robots_from_inside_itself(wheel, tmp_path):
    """Even still zipped."""
    code = "import armlab; print(armlab.__file__, armlab.load('puma560').n)"
    command = [sys.executable, "-P", "-c", f"import sys; sys.path.insert(0, {str(wheel)!r}); {code}"]
    result = subprocess.run(command, check=True, capture_output=True, text=True, cwd=tmp_path)
    path, joints = result.stdout.split()
    assert ".whl" in path
    assert joints == "6"
