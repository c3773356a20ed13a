"""QR codes of links."""

import re

import pytest

from armlab.benches.view.share.ui.qr import MOST, QUIET, qr_svg

LINK = "http://lab.example:8080/state/1"


@pytest.mark.parametrize("length", [len(LINK), 60, 300, MOST])
def test_a_code_fills_its_place_and_has_its_quiet_zone(length):
    svg = qr_svg(LINK.ljust(length, "a"))
    side = int(re.search(r'viewBox="0 0 (\d+) \1"', svg)[1])
    modules = side - 2 * QUIET
    assert (modules - 17) % 4 == 0
    assert modules <= 101
    assert not re.search(r"<svg[^>]* (width|height)=", svg)
    assert "<script" not in svg


def test_longer_links_have_larger_codes_and_too_long_ones_none():
    assert len(qr_svg(LINK)) < len(qr_svg(LINK.ljust(MOST, "a")))
    assert qr_svg("a" * (MOST + 1)) is None


def test_the_same_link_has_the_same_code_and_another_another():
    assert qr_svg(LINK) == qr_svg(LINK) != qr_svg(LINK + "a")


def test_what_stands_in_a_link_is_no_markup_of_the_code():
    assert "<b>" not in qr_svg(LINK + "<b>")
