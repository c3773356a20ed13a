"""The film of iterations: its examples, and what becomes of it when it is saved, and with other arms."""

import dataclasses
import json
import math
from itertools import combinations

import numpy as np
import pytest

from armlab.benches.iterate.runs.clip import configuration, place_of
from armlab.benches.iterate.runs.commands import (
    AddRun,
    ChooseMethod,
    ChooseTask,
    RemoveRun,
    SelectRun,
    SetParameter,
    SetStart,
)
from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import Iterations, StartIterations, arms_found, questions
from armlab.benches.iterate.runs.worked import FLOW, methods, run_of, step_size
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.ik.iterate import TaskVector, iterate, task_vector
from armlab.kin.ik.iterate.problem import Problem
from armlab.session.arm_on_clip import standing
from armlab.session.edits import AddJoint, PasteTable, SetCell, SetLimits
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, TakePose
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.session import Session, Undo
from armlab.session.share import from_short, short
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import OpenLesson
from support.clips import another_clip
from support.iterating import done, opened, started

# -- examples --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_one_step_of_undo_and_shows_its_first_picture(key):
    session = Session.fresh("student", catalogue()["scara"])
    session.apply(ChooseExample(key), 0.0)
    state, example = with_films(session.state), EXAMPLES[key]
    assert state[RobotPart].robot.key == example.robot
    np.testing.assert_allclose(state[Joints].q, example.start, atol=1e-12)
    assert state[Iterations].example == key
    assert state[Timeline].clip == "iterations"
    assert all(film.status != "refused" for film in state[Iterations].films.values())
    session.apply(Undo(), 1.0)
    assert session.state[RobotPart].robot.key == "scara"
    changed = apply(state, SetStart((0.1,) * len(example.start)))
    assert changed[Iterations].example == ""


def outcomes(key):
    part = done(opened(), ChooseExample(key))[Iterations]
    return [part.films[run.colour] for run in part.runs]


def test_the_runs_of_the_redundant_example_end_apart_from_each_other():
    films = outcomes("redundant")
    assert all(film.success for film in films)
    for one, other in combinations(films, 2):
        assert np.abs(one.q[-1] - other.q[-1]).max() > math.radians(5.0)


def test_the_examples_show_what_they_say():
    newton, gradient, _ = outcomes("orders")
    assert newton.last <= 6
    assert gradient.last > 40
    log = np.log10(gradient.position_error[10:50])
    assert np.ptp(np.diff(log)) < 0.02  # a straight line
    below, above = outcomes("step_size")
    assert below.success
    assert above.status == "diverged"
    assert "2/σ_max²" in above.reason
    assert all(film.status == "stuck" and film.last == 0 for film in outcomes("stretched"))
    jump, damped = outcomes("jump")
    assert np.abs(jump.step[0]).max() > 2.0 * math.pi
    assert np.abs(damped.step).max() < math.pi
    slow, quick = outcomes("lyapunov")
    assert all(np.all(np.diff(film.V) <= 0.0) and np.all(film.V_dot <= 0.0) for film in (slow, quick))
    one, four = (np.interp(time, film.t, film.position_error) for time, film in ((4.0, slow), (1.0, quick)))
    np.testing.assert_allclose(one, four, rtol=2e-2)


def test_the_two_arms_of_the_3r_are_found():
    state = done(opened(), ChooseExample("two_arms"))
    arm, found = state[Joints].arm, arms_found(state)
    assert len(found) == 2
    np.testing.assert_allclose(arm.fk(found)[:, :2, 3], [[1.2, 1.2]] * 2, atol=1e-5)
    np.testing.assert_allclose(np.cos(found[:, 2] - math.radians(30.0)), 1.0, atol=1e-10)
    assert np.sign(np.sin(found[0, 1])) != np.sign(np.sin(found[1, 1]))
    # With other components they are not there, and with other values they are looked for again.
    assert len(arms_found(apply(state, ChooseTask(None)))) == 0
    other = apply(state, ChooseTask(task_vector(arm, "xy", joints={3: 0.1})))
    assert len(arms_found(other)) == 0
    assert len(arms_found(with_films(other))) == 2


# -- written down, other arms, edits ---------------------------------------------------------------------------------


def test_it_is_written_and_read_back():
    state = done(
        opened("planar_3r"),
        ChooseTask(task_vector(catalogue()["planar_3r"].arm, "xy", joints={3: 0.5})),
        AddRun(FLOW),
        SetParameter(1, "alpha", 0.123),
        Set(Iterations, "limits", "none"),
        Set(Iterations, "most", 17),
    )
    again = State.from_json(json.loads(json.dumps(state.to_json())), state[RobotPart].robot)
    part, read = state[Iterations], again[Iterations]
    for name in ("start", "task", "runs", "selected", "limits", "most", "example"):
        assert getattr(part, name) == getattr(read, name), name
    np.testing.assert_array_equal(part.target, read.target)
    assert questions(again)[0][1:] == questions(state)[0][1:]
    linked = from_short(short(state))
    assert linked[Iterations].runs == part.runs


def test_what_is_not_touched_costs_nothing_in_a_link():
    assert len(short(opened())) < 60


@pytest.mark.parametrize(
    "damage",
    [
        {"start": [0.0]},
        {"start": [math.nan, 0.0]},
        {"target": [[1.0]]},
        {"runs": []},
        {"runs": [["magic", {}, 0]]},
        {"runs": [["newton", {}, 9]]},
        {"runs": [["newton", {}, 0], ["newton", {}, 0]]},
        {"runs": [["gradient", {"alpha": 1e9}, 0]]},
        {"selected": 5},
        {"limits": "maybe"},
        {"most": 10**9},
        {"task": {"task": "xy", "joints": [[9, 0.0]], "euler": None}},
        {"before": [1.0]},
    ],
)
def test_a_damaged_file_is_refused(damage):
    state = opened()
    with pytest.raises((InputError, KeyError, TypeError, ValueError)):
        Iterations.from_json({**state[Iterations].to_json(), **damage}, state[RobotPart].robot)


def test_another_arm_keeps_the_runs_and_an_edited_one_also_start_and_target():
    state = done(opened(), AddRun("ccd"), SetStart((0.3, 0.4)), Set(Iterations, "most", 9))
    other = with_films(apply(state, ChooseRobot("puma560")))
    assert [run.method for run in other[Iterations].runs] == ["newton", "gradient", "ccd"]
    assert other[Iterations].runs[1].values["alpha"] != state[Iterations].runs[1].values["alpha"]
    assert len(other[Iterations].start) == 6
    assert len(other[Iterations].films) == 3
    edited = with_films(apply(state, SetCell(0, "a", 0.7)))
    assert edited[Iterations].start == (0.3, 0.4)
    np.testing.assert_array_equal(edited[Iterations].target, state[Iterations].target)
    longer = with_films(apply(state, AddJoint(0)))
    assert len(longer[Iterations].start) == 3
    assert longer[Iterations].start[0] == 0.3
    assert longer[Iterations].start[2] == 0.4


def test_editing_the_table_while_the_film_is_on_goes_on_with_the_edited_arm():
    state = apply(started(q=(0.2, 1.0)), Seek(1.0))
    for command in (AddJoint(0), SetCell(0, "a", 0.7), SetLimits(0, -0.3, 0.3)):
        edited = apply(apply(state, command), Seek(0.5))
        shown = with_films(edited)
        arm = shown[Joints].arm
        assert shown[Iterations].film.q.shape[1] == arm.n
        np.testing.assert_allclose(
            shown[Joints].q, standing(arm, configuration(shown[Iterations].film, place_of(shown))), atol=1e-12
        )


def test_every_arm_opens_with_a_target_it_can_reach(robot):
    state = with_films(State.initial(robot))
    part, arm = state[Iterations], robot.arm
    films = [part.films[run.colour] for run in part.runs]
    assert all(np.isfinite(film.q).all() for film in films)
    # The first target is one of the tool's own poses, near home but not at it.
    assert np.abs(part.target - arm.fk(robot.home)).max() > 1e-3
    found = iterate(arm, part.target, part.start, "dls_error", most=200)
    assert found.success, found.reason


def test_random_commands_leave_a_usable_state(rng):
    state = opened()
    keys, other = list(methods()), another_clip(state, "iterations")
    for _ in range(60):
        part, n = state[Iterations], state[Joints].arm.n
        choices = [
            lambda n=n: StartIterations(tuple(rng.uniform(-7.0, 7.0, n).tolist())),
            lambda part=part: ChooseMethod(int(rng.integers(len(part.runs))), str(rng.choice(keys))),
            lambda: AddRun(str(rng.choice(keys))),
            lambda: RemoveRun(0),
            lambda part=part: SelectRun(int(rng.integers(len(part.runs)))),
            lambda: Set(Iterations, "most", int(rng.integers(1, 8))),
            lambda: Set(Iterations, "limits", str(rng.choice(["clamp", "none"]))),
            lambda: Seek(float(rng.uniform(0.0, 9.0))),
            lambda: OpenClip(str(rng.choice(["", "iterations", other]))),
            lambda: TakePose("zero"),
            lambda n=n: LockJoint(int(rng.integers(n)), bool(rng.integers(2))),
            lambda: ChooseRobot(str(rng.choice(["planar_2r", "scara", "elbow_3r"]))),
            lambda: ChooseExample(str(rng.choice(list(EXAMPLES)))),
        ]
        try:
            state = apply(state, choices[rng.integers(len(choices))]())
        except InputError:
            continue
        if rng.integers(3) == 0:
            state = with_films(state)
        arm, q = state[Joints].arm, state[Joints].q
        assert np.isfinite(q).all()
        assert arm.within_limits(q)
        assert duration(state) >= 0.0
        State.from_json(json.loads(json.dumps(state.to_json())), state[RobotPart].robot)
    assert run_of("newton").kind.title
    assert state[Target] is not None


# -- what it begins with ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", list(catalogue().found))
def test_newton_reaches_the_first_target_and_the_gradient_does_not_diverge(key):
    state = with_films(opened(key))
    part, arm = state[Iterations], state[Joints].arm
    first, gradient = (part.films[run.colour] for run in part.runs)
    assert first.success, first.reason
    assert gradient.status != "diverged", gradient.reason
    assert gradient.position_error[-1] < 0.5 * gradient.position_error[0]
    # Not beside a singular configuration, which would be an ill-conditioned lecture.
    assert first.sigma_min[-1] > 0.05 * (arm.length_scale if first.sigma_unit == "m" else 1.0)


KR16 = """a,alpha,d,theta
260,-90,675,q1
680,0,0,q2
-35,90,0,q3-90
0,-90,670,q4
0,90,0,q5
0,0,115,q6"""
OWN_SCARA = "a,alpha,d,theta\n250,0,400,q1\n200,180,0,q2\n0,0,d3,0\n0,0,50,q4"
OWN_2R = "a,alpha,d,theta\n250,0,0,q1\n200,0,0,q2"


@pytest.mark.parametrize("table", [KR16, OWN_SCARA, OWN_2R])
def test_an_own_arm_that_is_singular_at_zero_begins_beside_it(table):
    """A pasted table has no pose but q = 0, where the elbow is stretched or the wrist is straight."""
    state = with_films(apply(opened("puma560"), PasteTable(table)))
    part, arm = state[Iterations], state[Joints].arm
    assert arm.within_limits(part.start)
    assert part.films[0].success, part.films[0].reason
    assert part.films[1].position_error[-1] < 0.5 * part.films[1].position_error[0]
    assert apply(opened("puma560"), PasteTable(table))[Iterations].start == part.start


def test_the_step_size_of_a_gradient_is_below_its_bound_wherever_the_arm_stands():
    rng = np.random.default_rng(4)
    for key in ("planar_2r", "planar_3r", "elbow_3r", "puma560"):
        arm = catalogue()[key].arm
        vector = TaskVector(arm.task)
        problem = Problem(arm, np.asarray(arm.fk(np.zeros(arm.n))), vector, range(arm.n), clamp=False)
        sigma = problem.at(rng.uniform(-math.pi, math.pi, (500, arm.n))).sigma_max.max()
        assert 0.5 < step_size(arm, vector) * sigma**2 < 2.0
    # By hand: stretched, J of the 2R with links of 1 m has the one row (2, 1) m, so sigma_max^2 = 5 m^2.
    arm = catalogue()["planar_2r"].arm
    assert step_size(arm, TaskVector(arm.task)) == 0.3
    half = dataclasses.replace(arm, rows=tuple(dataclasses.replace(row, a=0.5) for row in arm.rows))
    assert step_size(half, TaskVector(half.task)) == 1.2


def test_a_lesson_with_a_target_begins_there_where_its_arm_stands():
    state = with_films(apply(opened("puma560"), OpenLesson("newton_arm")))
    part = state[Iterations]
    np.testing.assert_allclose(part.target[:3, 3], [1.2, 1.1, 0.0])
    np.testing.assert_allclose(part.start, np.radians([0.0, 90.0]))
    np.testing.assert_allclose(part.films[0].position_error[:3], [0.2236, 0.0211, 0.00025], atol=5e-5)
    other = apply(state, ChooseExample("orders"))
    np.testing.assert_allclose(other[Iterations].target[:3, 3], EXAMPLES["orders"].position)
