"""A bench is one folder: page, layer, state, film, long work, examples, style. A robot, a lesson, a check: one file."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from support.made_up import BENCH_FOLDER, FILES, LOOK, PAGE, PANEL

TOP = Path(__file__).resolve().parents[2]


@pytest.fixture
def house(tmp_path):
    """A copy of the checkout with one lesson; what is compiled comes along, or each test would compile it all."""
    for name in ("app", "robots"):
        shutil.copytree(TOP / name, tmp_path / name)
    (tmp_path / "lessons").mkdir()
    shutil.copytree(TOP / "lessons" / "first_arm", tmp_path / "lessons" / "first_arm")
    shutil.copy(TOP / "pyproject.toml", tmp_path)
    return tmp_path


def add(house, files):
    for name, text in files.items():
        (house / name).parent.mkdir(parents=True, exist_ok=True)
        (house / name).write_text(text, encoding="utf-8")


def with_panel(house, panel, page=PAGE):
    """Add a bench that is a panel and nothing else."""
    add(house, {name: text for name, text in FILES.items() if name.endswith("__init__.py")})
    add(house, {f"{BENCH_FOLDER}/__init__.py": page, f"{BENCH_FOLDER}/ui/page.py": panel})


def look(house, code=LOOK):
    paths = [str(house / "app"), str(TOP / "tests")]
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    return subprocess.run([sys.executable, "-c", code], env=variables, capture_output=True, text=True, cwd=house)


def test_a_bench_is_one_folder_all_else_one_file_and_there_is_no_other_edit(house):
    add(house, FILES)
    result = look(house)
    assert result.returncode == 0, result.stderr
    assert "grown" in result.stdout


@pytest.mark.parametrize(
    ("file", "text", "told"),
    [
        (f"{BENCH_FOLDER}/ui/page.py", "1 / 0", "ui.page: cannot be imported: ZeroDivisionError"),
        (f"{BENCH_FOLDER}/ui/scene_broken.py", "LAYER = 3", "scene_broken: LAYER must be a Layer, got int"),
    ],
)
def test_a_broken_plug_in_stops_the_start_and_is_named(house, file, text, told):
    with_panel(house, PANEL)
    add(house, {file: text})
    code = (
        "import sys\nfrom armlab.cli import main\nsys.exit(main(['--no-browser', '--port', '0', '--state', 'state']))"
    )
    result = look(house, code)
    assert result.returncode == 1
    assert told in result.stderr
    assert result.stderr.startswith("armlab: ")
    assert "Traceback" not in result.stderr


FAILING_PANEL = PANEL.replace("form = gui.form(post)", "1 / 0")


AGAIN = PAGE.replace('"made_up", "Made up"', '"again", "Again"')


def test_a_panel_that_fails_is_replaced_by_a_line_and_the_rest_lives_on(house):
    """One fails when it is built, the other when it is imported."""
    with_panel(house, FAILING_PANEL)
    again = f"{Path(BENCH_FOLDER).parent.as_posix()}/again"
    add(house, {f"{again}/__init__.py": AGAIN, f"{again}/ui/__init__.py": "", f"{again}/ui/page.py": "1 / 0"})
    code = """
import asyncio
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab

async def main(url):
    browser = FakeBrowser(url, cookie_of(url))
    await browser.connect()
    await browser.until(lambda: "al-notes" in browser.html())
    await browser.open("made_up", "again", "joints")
    await browser.until(lambda: "Made up has failed" in browser.html() and "Again has failed" in browser.html())
    before = browser.counts["SetOrientationMessage"]
    await browser.set_value(browser.slider(1), 20.0)
    await browser.until(lambda: browser.counts["SetOrientationMessage"] > before)
    await browser.close()

with running_lab() as url:
    asyncio.run(main(url))
print("lived on")
"""
    result = look(house, code)
    assert "lived on" in result.stdout, result.stderr
    assert result.stderr.count("ZeroDivisionError") >= 2


def test_the_examples_of_the_guide_work_as_printed(house):
    guide = (TOP / "docs/extending.md").read_text(encoding="utf-8")
    (robot,) = re.findall(r"```toml\n(.*?)```", guide, re.DOTALL)
    page, panel = re.findall(r"```python\n(.*?)```", guide, re.DOTALL)
    (house / "robots/from_the_guide.toml").write_text(robot, encoding="utf-8")
    with_panel(house, panel, page)
    code = """
import asyncio
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab

async def main(url):
    browser = FakeBrowser(url, cookie_of(url), "/")
    await browser.connect()
    await browser.until(lambda: "al-notes" in browser.html())
    await browser.open("distance")
    await browser.until(lambda: "1.000 m" in browser.html())
    await browser.close()

with running_lab(opening="from_the_guide") as url:
    asyncio.run(main(url))
print("as printed")
"""
    result = look(house, code)
    assert "as printed" in result.stdout, result.stderr
