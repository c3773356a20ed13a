"""Tabs and pages say their names: read without a pointer, large enough for a finger, and always in their places."""

import pytest

from armlab.session.pages import pages, tabs
from support.lab import running_lab
from support.own_lessons import lesson, write
from support.walk import PLACES

pytestmark = pytest.mark.browser

SIZES = [(1400, 850), (1024, 700), (820, 1180)]

LEAST = 32
"""Side of what a finger can hit, pixels."""

MORE = """() => {
  const strip = document.querySelector('[data-dock-region=right] [data-dock-strip][role=tablist]');
  for (const title of ['Orientation', 'Actuators']) {
    const tab = strip.lastElementChild.cloneNode(true);
    tab.querySelector('span').textContent = tab.dataset.name = title;
    strip.append(tab);
  }
}"""
"""Two tabs more than there are."""

UNREADABLE = """least => {
  const bad = [], boxes = [];
  for (const tab of document.querySelectorAll('[data-dock-region=right] [data-dock-tab]')) {
    const box = tab.getBoundingClientRect(), span = tab.querySelector('span'), style = getComputedStyle(span);
    const range = document.createRange();
    range.selectNodeContents(span);
    const text = range.getBoundingClientRect(), name = tab.dataset.name;
    const says = (what, wrong) => {
      if (wrong) bad.push(`${name}: ${what} ${JSON.stringify(box)} ${JSON.stringify(text)}`);
    };
    says('no text', !name || span.textContent !== name);
    says('small', box.width < least || box.height < least);
    says('outside', text.left < 0 || text.right > innerWidth || box.top < 0 || box.bottom > innerHeight);
    says('clipped', text.left < box.left || text.right > box.right || text.top < box.top || text.bottom > box.bottom);
    says('tiny', parseFloat(style.fontSize) < 10 || text.width < 10 || text.height < 10);
    says('pale', style.visibility !== 'visible' || style.clipPath !== 'none' || +getComputedStyle(tab).opacity < 1);
    const hit = document.elementFromPoint((text.left + text.right) / 2, (text.top + text.bottom) / 2);
    says('covered', !tab.contains(hit));
    says('beside another', boxes.some(b => Math.min(b.right, box.right) - Math.max(b.left, box.left) > 1
      && Math.min(b.bottom, box.bottom) - Math.max(b.top, box.top) > 1));
    boxes.push(box);
  }
  return boxes.length < 12 ? ['too few tabs'] : bad;
}"""
"""What is wrong with the names of the tabs, while no pointer is over them."""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    """A lab with a lesson that takes a tab away."""
    front = 'robot = "planar_2r"\npanel = "joints"\nhidden = ["pose", "orientation", "formulas", "spaces"]\n'
    folder = write(tmp_path_factory.mktemp("lessons"), posed=lesson(front=front))
    with running_lab(tmp_path_factory.mktemp("state"), lessons=folder) as address:
        yield address


SHEET = """() => {
  const sheet = document.querySelector('[role=tablist]').closest('.mantine-Paper-root').getBoundingClientRect();
  const scene = document.querySelector('canvas[data-engine]').getBoundingClientRect();
  return [innerWidth - sheet.width, scene.bottom - sheet.top].map(Math.round);
}"""
"""What a telephone's sheet lacks of the width of the window, and how much of the scene it covers."""


def test_every_tab_can_be_read_and_hit_without_a_pointer_over_it(visit):
    """Also with two tabs more, and by a finger, which hovers over nothing."""
    lab = visit(size=SIZES[0], has_touch=True)
    for more in (False, True):
        if more:
            lab.page.evaluate(MORE)
        for size in SIZES:
            lab.resize(size)
            lab.finds_none(f"() => ({UNREADABLE})({LEAST})")
            assert lab.page.locator("canvas").first.bounding_box()["width"] >= 0.55 * size[0]


def test_tabs_and_pages_say_what_they_are_and_keep_their_places(visit):
    """The places of the pages of every tab are looked at in `test_every_page`."""
    lab = visit("robot/puma560", size=SIZES[0])
    what_is_in_a_tab_is_said_at_once_and_not_once_more_a_second_later(lab)
    turning_the_pages_of_a_tab_moves_none_of_them(lab)
    the_key_of_every_page_still_opens_it(lab)
    lab.resize(SIZES[1])
    a_screen_reader_hears_each_tab_and_page_by_its_name(lab)
    lab.resize(SIZES[0])
    a_tab_is_torn_off_the_rail_sideways_and_tabs_apart_stand_above_their_panels(lab)


def what_is_in_a_tab_is_said_at_once_and_not_once_more_a_second_later(lab):
    said = "tab => getComputedStyle(tab, '::after').content"
    assert lab.tab("Velocity").evaluate(said) == "none"
    lab.tab("Velocity").hover()
    content = lab.tab("Velocity").evaluate(said)
    assert all(page.name in content for page in tabs()["velocity"])
    assert lab.page.locator("[data-dock-tab][title]").count() == 0
    lab.tab("Motion").focus()
    lab.page.keyboard.press("Tab")
    assert "Matrix exponential" in lab.tab("Control").evaluate(said)
    lab.page.keyboard.press("Enter")
    lab.rest()
    assert lab.tab("Control").evaluate(said) == "none"  # its pages are seen


def turning_the_pages_of_a_tab_moves_none_of_them(lab):
    lab.open_tab("Motion")
    places = lab.page.evaluate(PLACES)
    for page in tabs()["motion"]:
        lab.press(page.key)
        assert lab.page.locator(f'.page[data-cell="{page.key}"]').get_attribute("aria-selected") == "true"
        assert lab.page.evaluate(PLACES) == places


def the_key_of_every_page_still_opens_it(lab):
    for key in ("solve", "by_hand", "what_if", "loop"):
        lab.open_tab(key)
        assert lab.page.locator(f'.page[data-cell="{key}"]').get_attribute("aria-selected") == "true"
        assert lab.page.locator(f'.page[data-cell="{key}"]').inner_text().strip() == pages()[key].name


def a_screen_reader_hears_each_tab_and_page_by_its_name(lab):
    for tab in tabs().values():
        assert lab.page.get_by_role("tab", name=tab[0].title, exact=True).count() == 1
    lab.open_tab("Control")
    lab.tab("Control").hover()
    for page in tabs()["control"]:
        assert lab.page.get_by_role("tab", name=page.name, exact=True).count() == 1
    assert lab.page.get_by_role("tablist", name="Pages of Control").count() == 1


def a_tab_is_torn_off_the_rail_sideways_and_tabs_apart_stand_above_their_panels(lab):
    rail = "() => document.documentElement.hasAttribute('data-rail')"

    def drag(to):
        box = lab.tab("Pose").bounding_box()
        lab.page.mouse.move(box["x"] + 10, box["y"] + 10)
        lab.page.mouse.down()
        for at in ((box["x"] - 200, box["y"] + 200), to):
            lab.page.mouse.move(*at, steps=8)
            lab.frames(5)
        lab.page.mouse.up()

    assert lab.page.evaluate(rail)
    drag((500, 400))  # into the scene
    lab.until(lambda: lab.page.locator("[data-floating-window] [data-dock-tab]").count() == 1)
    assert lab.page.evaluate(rail)
    drag((1200, 840))  # below the other panel
    lab.until(lambda: not lab.page.evaluate(rail))
    lab.finds_none(f"() => ({UNREADABLE})({LEAST})")


def test_in_lessons_the_keys_pass_over_tabs_that_are_away_and_the_others_can_be_read(visit):
    lab = visit("lesson/posed", size=SIZES[0])
    arrow_keys_go_along_the_tabs_that_are_there_and_pass_over_the_others(lab)
    lab.page.locator("select[data-cell=lesson-key]").select_option("first_arm")
    lab.until(lambda: lab.tab("Pose").is_visible())
    lab.rest()
    assert "/lesson/first_arm" in lab.address()
    the_tabs_can_be_read(lab)


def arrow_keys_go_along_the_tabs_that_are_there_and_pass_over_the_others(lab):
    lab.until(lambda: not lab.tab("Pose").is_visible())
    lab.tab("Joints").focus()
    for key, title in (("ArrowDown", "Rotation"), ("ArrowUp", "Joints"), ("ArrowLeft", "Robot"), ("End", "Help")):
        lab.page.keyboard.press(key)
        lab.until(lambda title=title: lab.tab(title).get_attribute("aria-selected") == "true")
        assert lab.page.evaluate("() => document.activeElement.dataset.name") == title


def the_tabs_can_be_read(lab):
    lab.page.evaluate(MORE)
    for size in SIZES:
        lab.resize(size)
        lab.finds_none(f"() => ({UNREADABLE})({LEAST})")


def test_on_a_telephone_the_tabs_say_their_names_and_the_one_that_is_wanted_opens(visit):
    """There viser has a sheet below the scene instead of a dock."""
    lab = visit(size=(390, 844), has_touch=True)
    lab.page.locator('[role=button][aria-label="Expand panel Lessons"]').click()
    lab.until(lambda: lab.page.get_by_role("tab", name="Joints", exact=True).get_attribute("aria-selected") == "true")
    for tab in tabs().values():
        found = lab.page.get_by_role("tab", name=tab[0].title, exact=True)
        box = found.bounding_box()
        assert found.inner_text().strip() == tab[0].title
        assert min(box["width"], box["height"]) >= LEAST
    lab.until(lambda: lab.page.evaluate(SHEET) == [0, 0])
