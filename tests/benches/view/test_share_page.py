"""The page Share: whose computer a link means."""

import pytest

from armlab.benches.view.share.ui.page import HERE, Link, is_loopback
from armlab.content.robots import catalogue
from armlab.session.state import State
from armlab.ui.html import joined

STATE = State.initial(catalogue()["planar_2r"])


@pytest.mark.parametrize(
    ("address", "own"),
    [
        ("http://127.0.0.1:8080/state/a", True),
        ("http://127.8.9.1/state/a", True),
        ("http://localhost:8080/state/a", True),
        ("http://lab.localhost/state/a", True),
        ("http://[::1]:8080/state/a", True),
        ("http://192.168.1.20:8080/state/a", False),
        ("http://lab.example/state/127.0.0.1", False),
        ("http://localhost.example/state/a", False),
        ("https://[2001:db8::1]/state/a", False),
    ],
)
def test_a_link_that_only_this_computer_can_open_says_so_above_its_code(address, own):
    assert is_loopback(address) == own
    shown = str(joined(Link(address, STATE).markup(STATE)))
    assert (HERE in shown) == own
    assert "<svg" in shown
