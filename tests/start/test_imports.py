"""What the lab imports and reads, and when: nothing that a page does not need stands before it."""

import json
import pickle
import sys
from pathlib import Path

import pytest

import armlab
from support.command import command
from support.patience import WAIT

TESTS = Path(__file__).resolve().parents[1]

BEFORE_THE_PAGE = ("numpy", "scipy", "viser", "armlab.kin", "armlab.content", "armlab.session.state", "armlab.ui")
"""Packages without which the page is served: the browser unpacks it while they are imported."""

BEFORE_THE_ARM = ("scipy", "trimesh", "PIL", "markdown_it", "mdit_py_plugins", "segno", "armlab.commands")
"""Packages without which arm, handle and panels come to the page."""

SERVED = """
import json, sys, urllib.request
from armlab.front.start import Settings, start

def look(port):
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/") as page:
        print(json.dumps([page.status, list(sys.modules)]))

start(Settings("127.0.0.1", [0], "puma560", None), look).stop()
"""

OPENED = """
import asyncio, json, sys
sys.path.insert(0, sys.argv[1])
from armlab.content import lessons
from armlab.front.start import Settings, start
from support.student import student

async def main(url):
    browser = await student(url, path=sys.argv[2])
    html = browser.html()
    print(json.dumps([list(sys.modules), lessons._library.cache_info().currsize, html]))
    await browser.open("help")
    await browser.close()
    print(json.dumps(list(sys.modules)))

running = start(Settings("127.0.0.1", [0], "puma560", None))
asyncio.run(main(f"http://127.0.0.1:{running.port}/"))
running.stop()
"""


def said(code, *arguments):
    """Run code in a process of its own; return what it prints, line for line."""
    out, err = command(*arguments, code=code).communicate(timeout=WAIT)
    assert err == ""
    return [json.loads(line) for line in out.splitlines()]


def among(modules, packages):
    return [name for name in modules if any(name == package or name.startswith(f"{package}.") for package in packages)]


def panels(modules):
    return [name for name in modules if name.startswith("armlab.benches.") and name.endswith(".ui.page")]


def test_the_page_is_served_before_the_lab_behind_it_is_imported():
    ((status, modules),) = said(SERVED)
    assert status == 200
    assert among(modules, BEFORE_THE_PAGE) == []


def test_the_first_page_comes_without_other_panels_and_without_any_lesson():
    (modules, read, _), later = said(OPENED, TESTS, "/")
    assert among(modules, BEFORE_THE_ARM) == []
    assert panels(modules) == ["armlab.benches.joints.sliders.ui.page"]
    assert read == 0
    assert len(panels(later)) > 1, "a panel is imported when it is opened"


def test_a_link_to_a_lesson_opens_it_though_no_lesson_was_read_before():
    (_, read, html), _ = said(OPENED, TESTS, "/lesson/first_arm")
    assert read == 1
    assert armlab.content.lessons.lessons()["first_arm"].title in html


@pytest.mark.parametrize("before", [None, "/etc/ssl/own.pem"])
def test_the_front_trusts_no_other_machine_and_leaves_the_variable_as_it_was(before, monkeypatch):
    monkeypatch.delenv("SSL_CERT_FILE", raising=False)
    monkeypatch.delenv("SSL_CERT_DIR", raising=False)
    if before is not None:
        monkeypatch.setenv("SSL_CERT_FILE", before)
    code = (
        "import armlab.front, json, os; from aiohttp import connector; "
        "trusted = connector._SSL_CONTEXT_VERIFIED; "
        "print(json.dumps([os.environ.get('SSL_CERT_FILE'), trusted.cert_store_stats()['x509']]))"
    )
    assert said(code) == [[before, 0]]


def test_everything_the_package_offers_can_be_had_though_it_is_imported_late():
    look = "import armlab, json; print(json.dumps([dir(armlab), sorted(sys.modules)]))"
    code = f"{look}; from armlab import *; Arm, ik, Row"
    ((names, modules),) = said(code)
    assert set(armlab.__all__) <= set(names)
    assert among(modules, ("numpy", "armlab.kin", "armlab.content")) == []
    for name in armlab.__all__:
        assert getattr(armlab, name) is not None
    arm = armlab.load("planar_2r")
    assert isinstance(arm, armlab.Arm)
    assert pickle.loads(pickle.dumps(arm)).rows == arm.rows
    assert pickle.loads(pickle.dumps(armlab.Row)) is armlab.Row
    assert armlab.ik is sys.modules["armlab.kin.ik"]
    with pytest.raises(AttributeError, match="module 'armlab' has no attribute 'arms'"):
        armlab.arms  # noqa: B018
