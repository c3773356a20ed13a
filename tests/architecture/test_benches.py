"""A bench is a folder: what tabs may see of each other, what in them draws, and how far their styles reach."""

import json
import re
import shutil
import subprocess
import sys

import pytest

from armlab.session.bench import benches
from armlab.session.job import jobs
from armlab.session.pages import pages
from armlab.session.parts.timeline import clips
from armlab.ui.plugin import layers, panel
from support.everything import everything
from support.sources import PACKAGE, TOP, imports_of

DRAWING = ("armlab.ui", "viser", "trimesh", "latex2mathml")
"""What only the folders ``ui`` of benches may import."""

MARKUP = re.compile(r"""class=\\?["']([^"'{}]*)""")


def tab_of(name):
    """Return the tab a dotted name belongs to; empty for what is no bench's."""
    parts = name.split(".")
    return parts[2] if parts[:2] == ["armlab", "benches"] and len(parts) > 2 else ""


def trespasses(package):
    """Return every import of a bench that goes past the door of another tab, or draws outside ``ui``."""
    found = []
    for path in sorted((package / "benches").rglob("*.py")):
        tab, *inside = path.relative_to(package / "benches").parts
        for name in imports_of(path):
            other = tab_of(name)
            if other not in ("", tab) and not name.startswith(f"armlab.benches.{other}.api"):
                found.append(f"{path.relative_to(package)} imports {name}, which is no part of the api of {other}")
            draws = ".ui." in f"{name}." if other == tab else name.startswith(DRAWING)
            if "ui" not in inside and draws:
                found.append(f"{path.relative_to(package)} imports {name} and lies outside a folder ui")
    return found


def test_tabs_meet_in_their_api_and_only_what_is_seen_draws():
    assert trespasses(PACKAGE) == []


@pytest.mark.parametrize(
    ("file", "line"),
    [
        ("control/follow/state.py", "from armlab.benches.motion.plan.state import Plan"),
        ("control/follow/ui/page.py", "from armlab.benches.iterate.runs.ui.words import errors"),
        ("robot/table/state.py", "from armlab.ui.units import units_of"),
        ("motion/plan/job.py", "from armlab.benches.motion.plan.ui.points import marks"),
        ("motion/plan/job.py", "import viser"),
    ],
)
def test_a_planted_trespass_is_found(file, line, tmp_path):
    copy = tmp_path / "benches" / file
    copy.parent.mkdir(parents=True)
    copy.write_text((PACKAGE / "benches" / file).read_text(encoding="utf-8") + f"\n\n{line}\n", encoding="utf-8")
    assert len(trespasses(tmp_path)) >= 1


def classes(text):
    """Return the classes that stylesheets speak of."""
    return set(re.findall(r"\.([a-zA-Z][\w-]*)", re.sub(r"\{[^{}]*\}", "{}", text)))


def strangers(tab, markup, own, common, others):
    """Return the classes that markup of a tab takes from stylesheets of other tabs, which do not reach it.

    Classes of benches have a prefix, such as ``law-``; plain words stand behind one of these, and mean nothing alone.
    """
    used = {name for text in MARKUP.findall(markup) for name in text.split()}
    return sorted(name for name in used if "-" in name and name in others and name not in own | common)


def styles():
    """Return the classes of each tab's stylesheets, and those of the whole lab."""
    common = "".join(file.read_text() for file in (PACKAGE / "front" / "static").glob("*.css"))
    tabs = {folder.name: "" for folder in (PACKAGE / "benches").iterdir() if folder.is_dir()}
    for file in (PACKAGE / "benches").glob("*/*/style.css"):
        tabs[file.parts[-3]] += file.read_text()
    return {tab: classes(text) for tab, text in tabs.items()}, classes(common)


def test_markup_of_a_bench_uses_its_own_styles_and_the_common_ones():
    tabs, common = styles()
    found = {}
    for tab, own in tabs.items():
        others = set().union(*(names for key, names in tabs.items() if key != tab))
        markup = "".join(file.read_text() for file in (PACKAGE / "benches" / tab).rglob("*.py"))
        found[tab] = strangers(tab, markup, own, common, others)
    kit = "".join(file.read_text() for file in (PACKAGE / "ui").rglob("*.py"))
    found["ui"] = strangers("ui", kit, set(), common, set().union(*tabs.values()))
    assert {tab: names for tab, names in found.items() if names} == {}


def test_a_class_of_another_tab_is_found():
    tabs, common = styles()
    assert strangers("control", '<i class="law-name">', tabs["control"], common, tabs["motion"]) == ["law-name"]


def test_keys_that_are_written_as_text_exist():
    """Jobs and clips say on which pages they are wanted; what a lesson or a link names is looked up when it is read."""
    assert {clip.panel for clip in clips().values() if clip.panel} <= pages().keys()
    for file in (PACKAGE / "benches").glob("*/*/job*.py"):
        for key in re.findall(r'^(?:PANEL|PAGE) = "(\w+)"', file.read_text(), re.MULTILINE):
            assert key in pages(), f"{file}: there is no page {key!r}"


def test_what_lies_in_a_bench_is_found_and_nothing_twice():
    assert len(list((PACKAGE / "benches").glob("*/*/ui/page.py"))) == len(pages())
    assert len([key for key in pages() if panel(key).build]) == len(pages())
    assert len(list((PACKAGE / "benches").glob("*/*/ui/scene*.py"))) < len(layers())
    assert len(list((PACKAGE / "benches").glob("*/*/job*.py"))) == len(jobs())
    assert len(list((PACKAGE / "benches").glob("*/*/clip*.py"))) == len(clips())
    assert len(list((PACKAGE / "benches").glob("*/*/examples.py"))) == len(benches())


GONE = ("workspace", "iterate/basins")
"""A whole tab, and one page of a tab: folders of benches that no other bench builds on."""

WITHOUT = """
import asyncio
import json
from support.everything import everything
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from armlab.front.page import make_page
from armlab.session.play import problems

async def main(url):
    browser = FakeBrowser(url, cookie_of(url))
    await browser.connect()
    await browser.until(lambda: "al-notes" in browser.html())
    await browser.open("target", "velocity", "motion", "control", "iterations", "help")
    before = browser.counts["SetOrientationMessage"]
    await browser.set_value(browser.slider(1), 20.0)
    await browser.until(lambda: browser.counts["SetOrientationMessage"] > before)
    assert not any(title in browser.html() for title in ("Convergence map", "Workspace"))
    await browser.close()

with running_lab() as url:
    asyncio.run(main(url))
assert b".b-workspace" not in make_page().html
assert problems("first_arm") == []
print(json.dumps(everything()))
"""


@pytest.fixture(scope="module")
def without(tmp_path_factory):
    """A copy of the lab without some of its benches, and the variables to start it with."""
    copy = tmp_path_factory.mktemp("without")
    for name in ("app", "robots"):
        shutil.copytree(TOP / name, copy / name)
    (copy / "lessons").mkdir()
    for lesson in ("first_arm", "newton_arm"):
        shutil.copytree(TOP / "lessons" / lesson, copy / "lessons" / lesson)
    shutil.copy(TOP / "pyproject.toml", copy)
    for folder in GONE:
        shutil.rmtree(copy / "app/armlab/benches" / folder)
    return copy, {"PYTHONPATH": f"{copy / 'app'}:{TOP / 'tests'}", "PATH": "/usr/bin:/bin", "HOME": str(copy)}


def test_a_lab_without_some_benches_starts_and_shows_no_trace_of_them(without):
    copy, variables = without
    done = subprocess.run([sys.executable, "-c", WITHOUT], env=variables, capture_output=True, text=True, cwd=copy)
    assert done.stdout, done.stderr
    left, whole = json.loads(done.stdout), everything()
    missing = {kind: sorted(set(whole[kind]) - set(left[kind])) for kind in whole}
    assert missing["page"] == sorted(key for key, page in pages().items() if is_gone(page.package))
    for kind, name in (("job", "job*.py"), ("clip", "clip*.py"), ("bench", "examples.py"), ("facts", "facts.py")):
        files = [file for folder in GONE for file in (PACKAGE / "benches" / folder).rglob(name)]
        assert len(missing[kind]) == len(files), kind
    assert {"section", "dexterous", "basins"} <= set(missing["part"])
    assert all(set(left[kind]) <= set(whole[kind]) for kind in whole)


def is_gone(module):
    """Return whether a module lies in one of the folders that the copy does not have."""
    names = tuple(f"armlab.benches.{folder.replace('/', '.')}" for folder in GONE)
    return module in names or module.startswith(tuple(f"{name}." for name in names))


def test_a_lab_without_one_page_passes_the_tests_of_the_others_of_its_tab(without):
    copy, variables = without
    tab = TOP / "tests/benches/iterate"
    others = [file for file in sorted(tab.glob("test_*.py")) if not any(map(is_gone, imports_of(file)))]
    assert 1 < len(others) < len(list(tab.glob("test_*.py")))
    shutil.copytree(TOP / "tests/support", copy / "tests/support")
    shutil.copytree(TOP / "tests/data", copy / "tests/data")
    for file in (TOP / "tests/conftest.py", *others):
        (copy / file.relative_to(TOP)).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, copy / file.relative_to(TOP))
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "tests/benches"]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, cwd=copy)
    assert done.returncode == 0, done.stdout


def test_every_file_the_page_about_the_house_names_is_there():
    text = (TOP / "docs/house.md").read_text(encoding="utf-8")
    named = {name for name in re.findall(r"`((?:app|tests|benchmarks)/[\w./]+)`", text) if name == name.lower()}
    assert len(named) > 20
    assert [name for name in sorted(named) if not (TOP / name).exists()] == []
    for word in ("DragTarget", "OpenLesson", "Registry", "View"):
        assert any(f"class {word}" in file.read_text() for file in PACKAGE.rglob("*.py")), word
