"""Runs of kinematic control: their setups, and what becomes of them."""

import json
import math
from functools import cache

import numpy as np
import pytest

from armlab.benches.control.follow.chosen import KNOWLEDGE, MOST_RUNS, MOTORS, WAY, setup_of
from armlab.benches.control.follow.clip import stops
from armlab.benches.control.follow.commands import (
    AddRun,
    AimAt,
    ChooseInverse,
    ChooseLaw,
    ChooseReference,
    DropPushes,
    NameRun,
    PushNow,
    RemoveRun,
    SelectRun,
    SetOffset,
    SetOption,
    SetStart,
    SetValue,
    SizePush,
)
from armlab.benches.control.follow.examples import EXAMPLES, ChooseControlExample
from armlab.benches.control.follow.job import with_outcomes
from armlab.benches.control.follow.runs import SHOWN, reference_points
from armlab.benches.control.follow.state import Control, fresh, questions, starts_elsewhere
from armlab.benches.motion.plan.limits import LastFor
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.control import FixedPose, LineReference, Settings, simulate
from armlab.kin.dh import Row
from armlab.kin.transforms import transform
from armlab.session.bench import choosing
from armlab.session.edits import NewArm, PasteTable
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.target import PlaceTarget
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.share import state_of_parts
from armlab.session.state import apply
from support.control import done, opened, short_run


@cache
def example(key):
    """Return the state with an example and all its runs, which take seconds."""
    return done(opened(), choosing(f"control/{key}"))


@pytest.fixture(scope="module")
def short():
    return short_run()


# -- the notes' experiments as a student finds them ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "speeds", "at", "most", "last"),
    [
        ("line_170", (104.9, 108.4), 3.17, 0.0, 0.0),
        ("line_178", (518.6, 110.0), 3.17, 0.0, 0.0),
        ("saturated", (300.0, 110.0), 3.08, 47.99, 47.99),
        ("dls", (107.3, 110.1), None, 25.05, 0.0),
    ],
)
def test_the_presets_read_as_the_corrected_notes(key, speeds, at, most, last):
    state = apply(opened("puma560"), ChooseControlExample(key))
    state = done(state, *[RemoveRun(1) for _ in state[Control].runs[1:]])
    figures = state[Control].outcome.figures
    assert [round(math.degrees(peak.value), 1) for peak in figures.speeds] == pytest.approx(speeds, abs=0.05)
    if at is not None:
        assert figures.speeds[0].time == pytest.approx(at, abs=0.006)
    assert 1000.0 * figures.position.value == pytest.approx(most, abs=0.2)
    assert 1000.0 * figures.final_position == pytest.approx(last, abs=0.2)
    assert (figures.duration, figures.steps) == (6.0, 3000 if key == "dls" else 6000)


@pytest.mark.parametrize("key", [key for key in EXAMPLES if key not in ("line_170", "line_178", "saturated", "dls")])
def test_every_example_runs_to_its_end(key):
    state = example(key)
    part = state[Control]
    assert part.example == key
    assert len(part.runs) == len(EXAMPLES[key].runs)
    assert len({run.title for run in part.runs}) == len(part.runs)
    for run in part.runs:
        outcome = part.outcomes[run.colour]
        assert outcome.refused == ""
        assert outcome.run.finished, outcome.run.stopped
        assert len(outcome.run.t) <= SHOWN + 40
    assert (state[Timeline].clip, state[Timeline].time) == ("control", 0.0)


def test_errors_of_the_joints_begin_as_the_lesson_says_and_die_out_with_their_own_gains():
    run = example("joint_tracking")[Control].outcome.run
    np.testing.assert_allclose(run.error_joint[0], [0.2, -0.1], rtol=0, atol=1e-12)
    decay = np.exp(-np.outer(run.t, [1.0, 3.0]))
    np.testing.assert_allclose(run.error_joint, [0.2, -0.1] * decay, rtol=0, atol=1e-6)


def test_what_the_examples_say_is_so():
    def final(state, i):
        return 1000.0 * state[Control].outcomes[i].figures.final_position

    wrong = example("wrong_link")
    assert 15.0 < final(wrong, 0) < 25.0
    assert final(wrong, 2) < 1e-3
    pushed = example("push")
    assert final(pushed, 0) < 0.1
    assert final(pushed, 1) > 50.0
    sampled = example("sampling")
    assert final(sampled, 0) < 1.0
    assert final(sampled, 3) > 60.0
    regulated = example("regulation")
    way = regulated[Control].outcomes[0].run.p
    straight = np.linspace(way[0], way[-1], 50)
    assert np.abs(np.cross(way - way[0], straight[-1] - straight[0])[:, 2]).max() < 2e-2
    redundant = example("redundant")
    ends = [redundant[Control].outcomes[i].run.q[-1] for i in range(3)]
    assert np.abs(ends[1] - ends[0]).max() > math.radians(3.0)
    assert np.abs(ends[2] - ends[0]).max() > math.radians(3.0)


OWN = {
    "wrist straight": "0,90,0.29,q1\n0.27,0,0,q2\n0.07,90,0,q3\n0,-90,0.302,q4\n0,90,0,q5\n0,0,0.072,q6",
    "SCARA": "250,0,400,q1\n200,180,0,q2\n0,0,d3,0\n0,0,50,q4",
    "stretched": "250,0,0,q1\n200,0,0,q2",
    "to the back": "0,90,89,q1\n-425,0,0,q2\n-392,0,0,q3\n0,90,109,q4\n0,-90,95,q5\n0,0,82,q6",
}


@pytest.mark.parametrize("rows", OWN.values(), ids=OWN)
def test_the_first_run_of_an_own_arm_that_is_singular_at_zero_stays_on_its_line(rows):
    """A pasted table has no pose but q = 0."""
    state = done(opened("puma560"), PasteTable(f"a,alpha,d,theta\n{rows}"))
    arm, run = state[Joints].arm, state[Control].run
    assert arm.within_limits(np.array(run.start))
    assert starts_elsewhere(state)
    found = state[Control].outcome
    assert found.run.finished, found.run.stopped
    assert found.figures.sigma_min.value > 0.05
    assert found.figures.position.value < 0.05 * run.speed * run.duration
    assert not starts_elsewhere(apply(state, SetStart(tuple(np.zeros(arm.n)))))
    assert not starts_elsewhere(opened("puma560"))


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_largest_arm_is_put_on_the_table_and_read_back(convention):
    state = apply(opened(), NewArm((Row("R", a=100.0),) * 12, convention))
    part = state[Control]
    assert (part.run.speed, part.run.radius, part.push) == (20.0, 100.0, 10.0)
    written = json.dumps(state.to_json())
    assert json.dumps(state_of_parts(json.loads(written)).to_json()) == written


# -- setups ----------------------------------------------------------------------------------------------------------


def test_a_run_is_that_of_the_core(short):
    part, arm = short[Control], short[Joints].arm
    run = part.run
    along = [run.speed * math.cos(run.azimuth), run.speed * math.sin(run.azimuth), 0.0]
    line = LineReference(arm.fk(run.start), along, run.duration)
    same = simulate(arm, run.law, line, run.start, Settings(step=0.01, inverse=run.inverse))
    np.testing.assert_array_equal(part.outcome.run.q, same.q)
    np.testing.assert_allclose(part.outcome.run.p_wanted[[0, -1]], reference_points(arm, run), atol=1e-12)


def test_each_choice_changes_the_selected_run_and_only_that(short):
    state = apply(short, AddRun())
    part = state[Control]
    assert (part.selected, [run.colour for run in part.runs]) == (1, [0, 1])
    state = done(
        state,
        ChooseLaw("joint_tracking"),
        SetOption("law", "K", [2.0, 3.0]),
        SetOffset((0.1, -0.1)),
        SetValue("saturation", "scale"),
        SetValue("limit", 1.0),
        NameRun("  mine "),
    )
    part = state[Control]
    assert part.runs[0] == short[Control].run
    assert part.run.title == "mine"
    assert part.run.law_options == (("K", (2.0, 3.0)),)
    np.testing.assert_allclose(part.outcome.run.error_joint[0], [-0.1, 0.1])
    assert np.abs(part.outcome.run.qdot).max() <= 1.0 + 1e-12
    assert part.outcomes[0] is short[Control].outcomes[0]
    back = apply(state, SetOption("law", "K", None))
    assert back[Control].run.law_options == ()
    other = apply(state, ChooseLaw("open_loop"))
    assert other[Control].run.law_options == ()


def test_an_error_is_predicted_only_for_a_law_that_brings_it_to_zero(short):
    def predicted(*commands):
        state = done(short, SetOffset((0.2, -0.1)), *commands)
        return state[Control].outcome.predicted

    assert predicted(ChooseLaw("cartesian_tracking")) is None
    assert predicted(ChooseLaw("joint_tracking")) is not None
    assert predicted(ChooseLaw("joint_regulation")) is None
    assert predicted(ChooseLaw("joint_regulation"), ChooseReference("planned")) is None
    assert predicted(ChooseLaw("joint_regulation"), SetValue("speed", 0.0)) is not None
    assert predicted(ChooseLaw("joint_regulation"), ChooseReference("target")) is not None


def test_runs_are_kept_up_to_four_and_removed(short):
    state = short
    for _ in range(MOST_RUNS - 1):
        state = apply(state, AddRun())
    with pytest.raises(InputError, match="at most 4 runs"):
        apply(state, AddRun())
    state = apply(state, RemoveRun(1))
    assert [run.colour for run in state[Control].runs] == [0, 2, 3]
    state = apply(state, AddRun())
    assert sorted(run.colour for run in state[Control].runs) == [0, 1, 2, 3]
    for _ in range(3):
        state = apply(state, RemoveRun(0))
    with pytest.raises(InputError, match="at least one run is needed"):
        apply(state, RemoveRun(0))
    assert apply(state, SelectRun(0)) is state


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (SetValue("speed", -1.0), "speed: expected no negative number"),
        (SetValue("duration", 1e4), "duration: expected at least"),
        (SetValue("step", 1e-9), "step: expected"),
        (SetValue("wrong", 0.9), "at most 50 %"),
        (SetValue("link", 3), "link: expected 1 to 2"),
        (SetValue("colour", 1), "value of a run: unknown name"),
        (SetValue("integrator", "heun"), "integrator: unknown name"),
        (ChooseLaw("pid"), "control law: unknown name"),
        (ChooseInverse("qr"), "inverse: unknown name"),
        (ChooseReference("dance"), "reference: unknown name"),
        (SetOption("law", "Kd", 1.0), "options of cartesian_tracking"),
        (SetOption("plant", "Kp", 1.0), "expected that of its law"),
        (SetOption("law", "Kp", [-1.0]), "Kp: expected"),
        (SetStart((0.0,)), "start: expected 2 finite"),
        (SetOffset((0.0, 1e9)), "initial offset: a joint cannot take this value"),
        (SizePush(0.0), "push: expected more than 0"),
        (SizePush("far"), "push: expected metres"),
        (NameRun(None), "name of a run: expected text"),
        (ChooseReference([]), "reference: unknown name"),
        (ChooseLaw({}), "control law: unknown name"),
        (SetValue(["speed"], 1.0), "value of a run: unknown name"),
        (SetValue("counts", 10**9), "counts: expected a whole number, at most"),
        (ChooseControlExample([]), "example: unknown name"),
        (SelectRun(5), r"run \(counted from 0\): expected 0 to 0, got 5"),
        (ChooseControlExample("none"), "example: unknown name"),
    ],
)
def test_nonsense_is_refused_in_words(command, words):
    with pytest.raises(InputError, match=words):
        apply(opened(), command)


def test_too_many_steps_are_refused_whichever_is_changed_last():
    state = apply(opened(), SetValue("step", 2e-4))
    with pytest.raises(InputError, match="at most 60000 steps"):
        apply(state, SetValue("duration", 20.0))


def test_the_steps_of_a_planned_motion_are_counted_by_its_own_duration():
    fine = apply(apply(opened(), ChooseReference("planned")), SetValue("step", 1e-4))
    long = apply(apply(opened(), SetValue("duration", 60.0)), ChooseReference("planned"))
    long = apply(long, SetValue("step", 5e-4))
    assert long[Control].run.step == 5e-4
    with pytest.raises(InputError, match=r"at most 60000 steps, got 60 s / 0\.0005 s"):
        apply(long, ChooseReference("line"))
    outcome = done(apply(fine, LastFor(7.0)))[Control].outcome
    assert (outcome.run, outcome.refused) == (None, "T / h: expected at most 60000 steps, got 7 s / 0.0001 s")


def test_a_refusal_of_the_core_is_an_outcome_with_words():
    state = done(opened(), SetOption("law", "Kp", [1.0, 2.0, 3.0]))
    outcome = state[Control].outcome
    assert outcome.run is None
    assert "K_p: expected one gain, or 2" in outcome.refused
    assert fresh(state)
    stopped = done(opened(), SetStart((0.0, 0.0)), ChooseInverse("inverse"), ChooseLaw("open_loop"))
    assert "J⁻¹ does not exist" in stopped[Control].outcome.run.stopped
    assert duration(apply(stopped, OpenClip("control"))) == 1.0


# -- references ------------------------------------------------------------------------------------------------------


def test_regulation_follows_the_handle_and_is_done_anew(short):
    state = done(short, ChooseReference("target"), ChooseLaw("cartesian_regulation"), SetValue("duration", 3.0))
    first = state[Control].outcome
    goal = np.array(transform(position=[0.4, 1.1, 0.0]))
    state = apply(state, PlaceTarget(goal))
    assert not fresh(state)
    state = with_outcomes(state)
    outcome = state[Control].outcome
    assert outcome is not first
    np.testing.assert_allclose(outcome.run.p[-1], [0.4, 1.1, 0.0], atol=1e-5)
    np.testing.assert_allclose(outcome.run.q[0], state[Control].run.start)
    same = simulate(
        state[Joints].arm,
        "cartesian_regulation",
        FixedPose(goal, 3.0),
        state[Control].run.start,
        Settings(step=0.01, inverse="dls_variable"),
    )
    np.testing.assert_allclose(outcome.run.p[-1], same.p[-1], atol=1e-9)
    aimed = apply(apply(state, MoveJoint(0, 0.9)), AimAt())
    np.testing.assert_allclose(aimed[Control].target, aimed[Joints].tool_pose)


def test_the_planned_motion_is_planned_where_it_is_not_known(short):
    state = done(short, ChooseReference("planned"), SetValue("step", 0.01))
    outcome = state[Control].outcome
    assert outcome.run.finished
    np.testing.assert_allclose(outcome.run.q[0], state.derived(questions)[0].plan.waypoints[0].q, atol=1e-12)
    np.testing.assert_allclose(outcome.run.error_position.max(), 0.0, atol=1e-6)


def test_a_circle_closes():
    scale = 2.0 * math.pi * 0.1
    state = done(
        opened(),
        ChooseReference("circle"),
        SetValue("radius", 0.1),
        SetValue("speed", scale / 2.0),
        SetValue("duration", 2.0),
        SetValue("step", 0.01),
    )
    run = state[Control].outcome.run
    np.testing.assert_allclose(run.p_wanted[0], run.p_wanted[-1], atol=1e-12)
    assert np.ptp(run.p_wanted[:, :2], axis=0) == pytest.approx([0.2, 0.2], abs=1e-3)
    inside = reference_points(state[Joints].arm, state[Control].run)
    assert np.ptp(inside[:, :2], axis=0).max() == pytest.approx(0.2)


# -- pushes ----------------------------------------------------------------------------------------------------------


def test_a_push_comes_at_the_present_time_across_the_way(short):
    state = apply(short, OpenClip("control"))
    state = apply(apply(state, Seek(0.3)), SizePush(0.02))
    state = done(state, PushNow())
    (time, *by), run = state[Control].run.pushes[0], state[Control].outcome.run
    assert time == 0.3
    assert np.linalg.norm(by) == pytest.approx(0.02)
    assert abs(np.dot(by, run.p_wanted[-1] - run.p_wanted[0])) < 1e-12
    assert run.pushed == pytest.approx((0.3,))
    assert state[Timeline].time == 0.3
    assert 0.3 in [pytest.approx(each) for each in stops(state)]
    assert apply(state, DropPushes())[Control].run.pushes == ()
    half = apply(short, PushNow())
    assert half[Control].run.pushes[0][0] == 0.25
    with pytest.raises(InputError, match="no run yet"):
        apply(opened(), PushNow())
    many = short
    for _ in range(8):
        many = apply(many, PushNow())
    with pytest.raises(InputError, match="at most 8"):
        apply(many, PushNow())


def test_only_what_can_be_used_is_offered():
    def keys(group, **values):
        return [each.key for each in setup_of(catalogue()["planar_2r"], **values).seen(group)]

    assert keys(WAY) == ["speed", "azimuth", "elevation", "duration"]
    assert keys(WAY, reference="circle") == ["speed", "azimuth", "radius", "duration"]
    assert keys(WAY, reference="target") == ["duration"]
    assert keys(WAY, reference="planned") == []
    assert keys(MOTORS) == ["saturation"]
    assert keys(MOTORS, saturation="clip") == ["saturation", "limit", "slide_limit"]
    assert "ratio" not in keys(KNOWLEDGE, shaft="link")
