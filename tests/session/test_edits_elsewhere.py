"""What an edited table does to values that other pages keep for each joint."""

from dataclasses import replace

from armlab.benches.control.follow.state import Control
from armlab.benches.iterate.basins.state import Basins
from armlab.benches.iterate.runs.state import Iterations
from armlab.content.robots import catalogue
from armlab.session.edits import SetCell, SetKind
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State, apply


def test_radians_become_no_metres_where_values_are_kept_for_each_joint():
    """A joint that turned and now slides begins anew on the pages that have values of their own."""
    before = State.initial(catalogue()["planar_2r"])
    before = before.replace(
        replace(before[Iterations], start=(0.3, 0.9)), replace(before[Basins], rest=(0.3, 0.9)), before[Control]
    )
    after = apply(before, SetKind(1, "P"))
    home = after[RobotPart].robot.home
    assert after[Iterations].start == (0.3, home[1])
    assert after[Basins].rest == (0.3, home[1])
    assert after[Control].run.start == Control.initial(after[RobotPart].robot).run.start
    same = apply(before, SetCell(1, "a", 0.7))
    assert (same[Iterations].start, same[Basins].rest) == ((0.3, 0.9), (0.3, 0.9))
    assert same[Control].run.start == before[Control].run.start
