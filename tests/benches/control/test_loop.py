"""The bench of the velocity loop: its numbers, what it refuses, its film, and what is kept."""

import json
import math

import numpy as np
import pytest

from armlab.benches.control.loop.examples import EXAMPLES, ChooseLoopExample
from armlab.benches.control.loop.state import Loop, present_time
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.bench import choosing
from armlab.session.fields import Set
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import State, apply
from support.clips import another_clip
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def test_the_examples_read_what_their_sentences_say():
    gains = {
        key: round(float(example.part.loop.closed_gain(example.part.omega)), 3)
        for key, example in EXAMPLES.items()
        if example.part.kind == "sine"
    }
    assert gains == {"omega_2": 0.981, "omega_20": 0.447, "cutoff": 0.707, "larger_gain": 0.981}
    loop = EXAMPLES["omega_2"].part
    assert loop.loop.steady_error(loop.reference) == pytest.approx(0.196, abs=5e-4)
    assert -float(loop.loop.phase(2.0)) / 2.0 == pytest.approx(0.0987, abs=5e-5)
    step = EXAMPLES["step"].part
    assert step.loop.time_constant == 0.5
    error = step.loop.error([0.0, 0.5, 2.5], step.reference, step.v0)
    assert error[1] / error[0] == pytest.approx(0.37, abs=5e-3)
    assert error[2] / error[0] < 0.01


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_an_example_is_put_in_place_and_left_by_a_change(key):
    state = opened(choosing(f"loop/{key}"))
    part = state[Loop]
    assert part.example == key
    assert part.times[0] == 0.0
    assert part.times[-1] == part.end
    assert np.all(np.diff(part.times) > 0.0)
    changed = apply(state, Set(Loop, "gain", part.gain * 2.0))[Loop]
    assert (changed.example, changed.gain) == ("", part.gain * 2.0)


def test_a_step_has_no_frequency_to_set():
    part = opened(Set(Loop, "kind", "step"))[Loop]
    assert "omega" not in [field.key for field in part.fields]
    assert opened(Set(Loop, "kind", "sine"))[Loop].example == "omega_2"


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (Set(Loop, "mass", 0.0), "mass: expected at least 0.001"),
        (Set(Loop, "gain", math.nan), "gain: expected finite"),
        (Set(Loop, "end", 1e4), "end: expected at least 0.001 s and at most 600 s"),
        (Set(Loop, "omega", None), "omega"),
        (Set(Loop, "colour", 1.0), "unknown name 'colour'"),
        (Set(Loop, "omega", 1000.0), "at most 40 can be shown: expected up to 0.251 s"),
        (Set(Loop, "kind", "ramp"), "unknown name 'ramp'"),
        (ChooseLoopExample("nothing"), "unknown name 'nothing'"),
    ],
)
def test_nonsense_is_refused(command, says):
    with pytest.raises(InputError, match=says):
        opened(command)


def test_the_film_stops_at_quarters_of_the_sine_and_at_time_constants_of_a_step():
    state = opened(OpenClip("loop"), Step(True))
    assert duration(state) == 6.0
    assert present_time(state) == pytest.approx(math.pi / 4)
    state = opened(ChooseLoopExample("step"), OpenClip("loop"), Step(True))
    assert present_time(state) == pytest.approx(0.5)
    assert present_time(opened()) == 0.0


def test_another_loop_rewinds_its_film_and_leaves_other_clips_alone():
    state = opened(OpenClip("loop"), Seek(3.0))
    assert apply(state, Set(Loop, "gain", 20.0))[Timeline].time == 0.0
    other = opened(OpenClip(another_clip(state, "loop")), Seek(3.0))
    assert apply(other, Set(Loop, "gain", 20.0))[Timeline].time == 3.0


def test_it_is_written_read_back_and_kept_with_another_arm():
    state = opened(ChooseLoopExample("omega_20"), Set(Loop, "mass", 2.5))
    part, robot = state[Loop], state[RobotPart].robot
    assert Loop.from_json(json.loads(json.dumps(part.to_json())), robot) == part
    assert apply(state, ChooseRobot("puma560"))[Loop] == part
    for damage in ({"mass": 0.0}, {"kind": "ramp"}, {"omega": "x"}, {"end": math.inf}):
        with pytest.raises(InputError):
            Loop.from_json({**part.to_json(), **damage}, robot)
