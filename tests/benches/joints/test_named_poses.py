"""The buttons of the named poses."""

from armlab.content.robots import OWN, catalogue, parse_robot
from armlab.content.write_robot import robot_toml
from support.bare_gui import BarePage, words


def test_a_name_of_ones_own_keeps_its_capitals():
    text = robot_toml(catalogue()["planar_2r"]).replace('name = "home"', 'name = "pick A"')
    page = BarePage("joints", parse_robot(OWN, text, proven=False))
    assert "Pick A" in words(page)
    assert "Pick a" not in words(page)
