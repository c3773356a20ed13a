"""What a change of the arm does to an exercise that is half done, and which saved exercises are refused."""

import json

import numpy as np
import pytest

from armlab.benches.robot.trainer.answers import Answers
from armlab.benches.robot.trainer.commands import CheckAxes, CheckTable, ChooseDirection, SetAnswer, StartTrainer
from armlab.benches.robot.trainer.state import Trainer
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.edits import Convert, SetCell, SetEnd, SetLimits
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.state import State, apply


def placed(state):
    state = apply(state, StartTrainer())
    for i, (z, x) in enumerate(state[Trainer].exercise.solution):
        state = apply(apply(state, ChooseDirection(i, "z", z)), ChooseDirection(i, "x", x))
    return apply(state, CheckAxes())


def read_back(state):
    data = json.loads(json.dumps(state.to_json()))
    return State.from_json(data, robot_from_json(data["robot"]))


def test_a_change_that_leaves_the_exercise_keeps_the_answers():
    state = apply(apply(placed(State.initial(catalogue()["planar_2r"])), SetAnswer(0, "a", 1.0)), CheckTable())
    moved = np.eye(4)
    moved[:3, 3] = 0.0, 0.5, 0.2
    for command in (SetLimits(1, -2.0, 2.0), SetEnd("tool", moved), SetEnd("base", moved), Convert("modified")):
        after = apply(state, command)
        assert after[RobotPart].own
        assert after[Trainer].answers == state[Trainer].answers
        assert after[Trainer].exercise.robot is after[RobotPart].robot
        assert after[Trainer].cell_marks[0]["a"].ok
        assert read_back(after)[Trainer].answers == state[Trainer].answers


def test_a_change_of_the_exercise_begins_anew():
    state = apply(placed(State.initial(catalogue()["planar_2r"])), SetAnswer(0, "a", 1.0))
    turned = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    # Limits without zero move the pose of the exercise.
    for command in (SetCell(0, "a", 0.7), SetEnd("base", turned), SetLimits(0, 0.5, 2.0)):
        after = apply(state, command)[Trainer]
        assert not after.started
        assert after.answers == Answers.empty(2)


@pytest.mark.parametrize(
    "damage", [{"checked_axes": [["+z", "+x"]] * 8}, {"axes": [["+z", "+x"]] * 8}, {"axes_checks": 1}]
)
@pytest.mark.parametrize("key", ["panda", "iiwa7"])
def test_answers_to_an_exercise_that_has_not_begun_are_refused(damage, key):
    data = Trainer.initial(catalogue()[key]).to_json()
    assert Trainer.from_json(data, catalogue()[key]).frame_marks == (None,) * 8
    with pytest.raises(InputError, match="has not begun"):
        Trainer.from_json(data | damage, catalogue()[key])


def test_a_small_arm_is_marked_by_its_size():
    state = State.initial(catalogue()["planar_2r"])
    for i in range(2):
        state = apply(state, SetCell(i, "a", 0.02))
    state = apply(apply(placed(state), SetAnswer(0, "a", 0.0204)), CheckTable())
    assert not state[Trainer].cell_marks[0]["a"].ok
