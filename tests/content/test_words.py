"""Texts of the lab in the words of another language."""

import pytest

from armlab.content.po import Message
from armlab.content.words import Words


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("2 m away, turned by 1.5 rad at 3 rad/s", "a 2 m, ruotato di 1.5 rad a 3 rad/s"),
        ("2 mm away, turned by 1.5 rad at 3 rad/s", "a 2 mm, ruotato di 1.5 rad a 3 rad/s"),
        ("2 mm away, turned by 5° at 3 °/s", "a 2 mm, ruotato di 5° a 3 °/s"),
        ("moves in rad", "mosse in rad"),
        ("1.5 rad after 2 m", "1.5 rad after 2 m"),  # the translation has them in another order
    ],
)
def test_a_message_is_found_in_the_units_of_the_reader(text, says):
    known = [("{0} mm away, turned by {1}° at {2} °/s", "a {0} mm, ruotato di {1}° a {2} °/s")]
    known += [("moves in °", "mosse in °"), ("{0}° after {1} mm", "dopo {1} mm, {0}°")]
    assert Words([Message(*each) for each in known])(text) == says
