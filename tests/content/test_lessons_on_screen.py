"""What lessons name of the screen is there: panels and switches of the picture. (The content layer knows neither.)"""

import pytest

from armlab.content.lessons import lessons
from armlab.session.pages import pages
from armlab.ui.plugin import switches


@pytest.fixture(params=list(lessons().lessons))
def given(request):
    return lessons()[request.param]


def test_its_panel_is_there(given):
    assert given.panel in ("", *pages())


def test_its_overlays_are_switches_of_the_picture(given):
    assert set(given.overlays) <= {switch.name for switch in switches()}


def test_what_it_hides_is_a_panel(given):
    assert set(given.hidden) <= set(pages())
