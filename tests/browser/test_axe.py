"""Every page of the lab, in both looks, as axe-core sees it; and the console says nothing meanwhile."""

import pytest

from support.axe import findings
from support.walk import every_page

pytestmark = pytest.mark.browser


def test_axe_finds_nothing_serious_on_any_page(visit):
    """What lies around the panel is looked at once; the dark look, of the same rules of style, on every other page."""
    lab = visit(size=(1400, 850))
    found = {"around": findings(lab)}
    for k, key in enumerate(every_page(lab)):
        found[key] = [*findings(lab, ("light", "dark")[: 1 + k % 2], whole=False), *lab.errors]
    assert {key: bad for key, bad in found.items() if bad} == {}


def test_axe_sees_what_is_pale_and_what_has_no_name(visit):
    """The judge is there: a text too pale, in the dark look only, and a button without a name are found."""
    lab = visit()
    lab.page.evaluate(
        """() => {
          const shown = [...document.querySelectorAll('[data-dock-leaf] .al')].find(each => each.offsetHeight > 50);
          shown.insertAdjacentHTML('beforeend', '<p style="color: #39424f">in the dark</p><button></button>');
        }"""
    )
    found = findings(lab)
    assert [each.split(" at ")[0] for each in found] == ["light: button-name", "dark: color-contrast"]
