"""The film of iterations in a real page: an example, its film, its numbers, and the tangents of one variable."""

import numpy as np
import pytest

from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations
from armlab.content.robots import catalogue
from armlab.session.arm_on_clip import standing
from armlab.session.state import State, apply

pytestmark = pytest.mark.browser
ARM = catalogue()["planar_2r"].arm


def film_of(key):
    return with_films(apply(State.initial(catalogue()["planar_2r"]), ChooseExample(key)))[Iterations].film


def present_row(lab):
    """Return the texts of the row of the present iterate."""
    return lab.page.locator(".kit-table tr.now td").all_inner_texts()


def bodies(lab):
    """Return how far the page has turned the arm's joints, in degrees."""
    nodes = sorted(name for name in lab.nodes() if "/arm/" in name and name.rsplit("/", 1)[1].isdigit())
    found = lab.page.evaluate("names => names.map(name => window.__viserMutable.nodePoseData[name].wxyz)", nodes)
    return [2.0 * np.degrees(np.arctan2(wxyz[3], wxyz[0])) for wxyz in found]


def test_an_example_plays_steps_rewinds_and_says_how_it_ended(visit):
    lab = visit()
    lab.open_tab("Iterate")
    lab.page.locator('select[data-cell="example"]').select_option("orders")
    lab.page.locator(".kit-look", has_text="Newton's curve bends down").wait_for()
    assert EXAMPLES["orders"].says in lab.page.locator(".kit-look").inner_text()
    lab.page.locator(".it-run p.ok").nth(2).wait_for()
    said = lab.page.locator(".it-run p").all_inner_texts()
    assert [text.split(" in ")[0] for text in said] == ["✓ Converged"] * 3
    film = film_of("orders")
    for k in (1, 2):
        lab.page.keyboard.press("Period")
        lab.until(lambda k=k: present_row(lab)[:1] == [str(k)])
    lab.rest()
    number, q1, q2, error, _ = present_row(lab)
    assert number == "2"
    np.testing.assert_allclose(
        [float(text.replace("−", "-")) for text in (q1, q2, error)],
        [*np.degrees(film.q[2]), 1e3 * film.position_error[2]],
        atol=0.051,
    )
    turned = (np.array(bodies(lab)) - np.degrees(standing(ARM, film.q[2])) + 180.0) % 360.0 - 180.0
    np.testing.assert_allclose(turned, 0.0, atol=0.1)
    lab.page.locator('.al-time button[data-cell="play"]').click()
    lab.until(lambda: present_row(lab)[:1] == [str(film.last)])
    lab.page.locator('.kit-table button[data-cell="row 0"]').click()
    lab.until(lambda: present_row(lab)[:1] == ["0"])
    lab.page.locator('.al-time button[data-cell="close"]').click()
    lab.page.locator(".al-time").wait_for(state="detached")
    _marks_what_makes_no_sense_and_changes_nothing(lab)
    lab.press("newton_1d")
    _plays_the_tangents_of_one_variable(lab)
    assert lab.errors == []


def _marks_what_makes_no_sense_and_changes_nothing(lab):
    lab.type_into("most", "many")
    refusal = lab.page.locator("p.no[role=alert]").first.inner_text()
    assert "expected a whole number from 1 to 500, got 'many'" in refusal
    lab.type_into("most", "12")
    assert lab.page.locator('input[data-cell="most"]').input_value() == "12"


def _plays_the_tangents_of_one_variable(lab):
    lab.page.locator(".it-tangents").wait_for()
    lab.page.locator('select[data-cell="equation"]').select_option("cycle")
    lab.page.locator(".al .no", has_text="the iterates repeat in a cycle").wait_for()
    lab.press("iterate 3")
    lab.until(lambda: present_row(lab)[:1] == ["3"])
    assert present_row(lab)[1].startswith("1.0000")
    lab.page.keyboard.press("Comma")
    lab.until(lambda: present_row(lab)[:1] == ["2"])
