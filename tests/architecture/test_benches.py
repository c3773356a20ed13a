"""A bench is a folder: what tabs may see of each other, what in them draws, and how far their styles reach."""

import ast
import json
import re
import shutil
import subprocess
import sys
from functools import cache

import pytest

from armlab.content.check import check_types
from armlab.content.vocabulary import vocabularies
from armlab.session.bench import benches
from armlab.session.job import jobs
from armlab.session.pages import pages
from armlab.session.parts.timeline import clips
from armlab.ui.plugin import layers, panel
from support.everything import everything
from support.sources import PACKAGE, TOP, files_with, imports_of, tree_of

DRAWING = ("armlab.ui", "viser", "trimesh", "latex2mathml")
"""What only the folders ``ui`` of benches may import."""


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
    """Return the classes with a prefix, such as ``law-name``, that stylesheets speak of.

    Plain words stand behind one of these, and mean nothing alone.
    """
    plain = re.sub(r"\{[^{}]*\}", "{}", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))
    return {name for name in re.findall(r"\.([a-zA-Z][\w-]*)", plain) if "-" in name}


def words_with_prefix(files):
    """Return the words with a prefix in the texts of modules: classes of elements, and others."""
    return set().union(*map(_words_with_prefix, files))


@cache
def _words_with_prefix(file):
    """Return those of one file, which both its page and its tab are asked for."""
    texts = (node.value for node in ast.walk(tree_of(file)) if isinstance(node, ast.Constant))
    written = [text for text in texts if isinstance(text, str) and "-" in text]
    return {word for text in written for word in re.split(r"[^\w-]+", text) if "-" in word}


COMMON = classes("".join(file.read_text() for file in (PACKAGE / "front" / "static").glob("*.css")))


def styles(package):
    """Return the classes of the stylesheet of each page, by its folder."""
    sheets = sorted((package / "benches").glob("*/*/style.css"))
    return {sheet.parent: classes(sheet.read_text(encoding="utf-8")) - COMMON for sheet in sheets}


def strangers(package):
    """Return what uses a class of another tab, whose styles do not reach it, or has a style that it does not use."""
    own = styles(package)
    of_tabs = {tab: set().union(*(own[page] for page in own if page.parent == tab)) for tab in {p.parent for p in own}}
    every = set().union(*of_tabs.values())
    found = []
    for tab in [*sorted((package / "benches").glob("*/")), package / "ui", package / "window"]:
        strange = words_with_prefix(tab.rglob("*.py")) & every - of_tabs.get(tab, set())
        found += [f"{tab.relative_to(package)} uses the class {name} of another tab" for name in sorted(strange)]
    for page, names in own.items():
        used = words_with_prefix(page.rglob("*.py"))
        begun = tuple(word for word in used if word.endswith("-"))  # the program completes them
        unused = sorted(name for name in names - used if not name.startswith(begun))
        found += [f"{page.relative_to(package)} has a style for {name}, which it does not use" for name in unused]
    return found


def test_a_stylesheet_is_that_of_its_page_and_reaches_only_its_tab():
    assert strangers(PACKAGE) == []


@pytest.mark.parametrize(
    ("file", "line", "told"),
    [
        (
            "control/loop/ui/page.py",
            'NAME = tag("i.law-name")',
            "benches/control uses the class law-name of another tab",
        ),
        ("control/loop/ui/page.py", 'NAME = tag("i", class_="law-name")', "benches/control uses the class law-name"),
        ("control/loop/style.css", ".exp-other { margin: 0; }", "control/loop has a style for exp-other"),
    ],
)
def test_a_style_in_the_wrong_place_is_found(file, line, told, tmp_path):
    for page in ("control/loop", "motion/laws"):
        shutil.copytree(PACKAGE / "benches" / page, tmp_path / "benches" / page)
    (tmp_path / "ui").mkdir()
    planted = tmp_path / "benches" / file
    planted.write_text(f"{planted.read_text(encoding='utf-8')}\n\n{line}\n", encoding="utf-8")
    (found,) = strangers(tmp_path)
    assert told in found


OF_PAGES = {"PANEL", "PANELS", "PAGE", "PAGES"}
"""Names of constants of benches that hold keys of pages."""


def keys_written(package):
    """Return file and key of every page that a bench names by a text: in such a constant, or where panels are asked."""
    found = []
    names = "|".join([*OF_PAGES, "panels"])
    for file in files_with(sorted((package / "benches").glob("*/*/**/*.py")), rf"\b(?:{names})\b"):
        for node in ast.walk(tree_of(file)):
            if isinstance(node, ast.Assign) and OF_PAGES & {getattr(target, "id", "") for target in node.targets}:
                if not (isinstance(node.value, ast.Call) and getattr(node.value.func, "id", "") in ("Page", "Panel")):
                    found += [(file, text) for text in _texts(node.value)]
            elif isinstance(node, ast.Compare) and "panels" in map(ast.unparse, node.comparators):
                found += [(file, text) for text in _texts(node.left)]
            elif isinstance(node, ast.Call) and ast.unparse(node.func).startswith("panels."):
                found += [(file, text) for argument in node.args for text in _texts(argument)]
    return found


def _texts(tree):
    return [node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)]


def test_keys_that_are_written_as_text_exist():
    """What a lesson or a link names is looked up when it is read."""
    assert {clip.panel for clip in clips().values() if clip.panel} <= pages().keys()
    written = keys_written(PACKAGE)
    assert len(written) > 20
    assert [f"{file.relative_to(PACKAGE)}: {key}" for file, key in written if key not in pages()] == []


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("target/solutions/job.py", '"by_hand"', '"by_hnd"'),
        ("motion/plan/job.py", '"motion_pick"', '"mition"'),
        ("motion/pick/ui/scene.py", '"motion_plots"', '"motion_plts"'),
        ("workspace/section/job.py", "PANEL in panels", '"sektion" in panels'),
        ("workspace/section/job.py", "PANEL in panels", 'panels.intersection({"sektion"})'),
    ],
)
def test_a_planted_key_of_no_page_is_found(file, old, new, tmp_path):
    text = (PACKAGE / "benches" / file).read_text(encoding="utf-8")
    assert old in text
    planted = tmp_path / "benches" / file
    planted.parent.mkdir(parents=True)
    planted.write_text(text.replace(old, new), encoding="utf-8")
    assert new.split('"')[1] in {key for _, key in keys_written(tmp_path) if key not in pages()}


def test_what_lies_in_a_bench_is_found_and_nothing_twice():
    assert len(list((PACKAGE / "benches").glob("*/*/ui/page.py"))) == len(pages())
    assert len([key for key in pages() if panel(key).build]) == len(pages())
    assert len(list((PACKAGE / "benches").glob("*/*/ui/scene*.py"))) < len(layers())
    assert len(list((PACKAGE / "benches").glob("*/*/job*.py"))) == len(jobs())
    assert len(list((PACKAGE / "benches").glob("*/*/clip*.py"))) == len(clips())
    assert len(list((PACKAGE / "benches").glob("*/*/examples.py"))) == len(benches())
    assert len(list((PACKAGE / "benches").glob("*/*/vocabulary.py"))) == len(vocabularies())
    checks = [*(PACKAGE / "content/checks").glob("[a-z]*.py"), *(PACKAGE / "benches").glob("*/*/check*.py")]
    assert len(checks) == len(check_types())


GONE = ("workspace", "iterate/basins")
"""A whole tab, and one page of a tab: folders of benches that no other bench builds on."""

WITHOUT = """
import asyncio
import json
from support.everything import everything
from support.fake_browser import FakeBrowser, cookie_of
from support.lab import running_lab
from armlab.front.page import make_page
from armlab.teaching.play import problems

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
    for file in (TOP / "tests/conftest.py", TOP / "tests/benches/conftest.py", *others):
        (copy / file.relative_to(TOP)).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, copy / file.relative_to(TOP))
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "--assert=plain"]
    done = subprocess.run([*command, "tests/benches"], env=variables, capture_output=True, text=True, cwd=copy)
    assert done.returncode == 0, done.stdout


def named_in(text):
    """Return what a page names in the code: files and folders, and words that are no file."""
    quoted = {name for name in re.findall(r"`([\w./]+)`", text) if "TAB" not in name}
    return {name for name in quoted if "/" in name}, {name for name in quoted if "/" not in name}


def nowhere(text):
    """Return the names of a page that lead nowhere."""
    files, words = named_in(text)
    of_pages = {"/".join(path.relative_to(PACKAGE / "benches").parts[2:]) for path in (PACKAGE / "benches").rglob("*")}
    lost = [name for name in sorted(files) if not (TOP / name).exists() and name not in of_pages]
    every = words_of_the_code()
    names = {path.name for path in (PACKAGE / "benches").rglob("*")}
    return lost + [word for word in sorted(words) if word not in (names if "." in word else names | every)]


@cache
def words_of_the_code():
    """Return every word that is written in the package."""
    code = "".join(file.read_text(encoding="utf-8") for file in PACKAGE.rglob("*.py"))
    return set(re.findall(r"\w+", code))


def test_every_name_on_the_page_about_the_house_leads_somewhere():
    text = (TOP / "docs/house.md").read_text(encoding="utf-8")
    files, words = named_in(text)
    assert len(files) > 40
    assert len(words) > 15
    assert nowhere(text) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("lessons/course.toml", "lessons/kourse.toml"),
        ("`OpenLesson`", "`OpenLessons`"),
        ("`examples.py`", "`exampels.py`"),
        ("`ui/scene.py`", "`ui/szene.py`"),
        ("app/armlab/ui/door.py", "app/armlab/ui/dor.py"),
    ],
)
def test_a_name_that_leads_nowhere_is_found(old, new):
    text = (TOP / "docs/house.md").read_text(encoding="utf-8")
    assert old in text
    assert nowhere(text.replace(old, new)) == [new.strip("`")]
