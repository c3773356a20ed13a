"""The film of iterations: its inputs, what the runs give, and how the arm follows it."""

import math

import numpy as np
import pytest

from armlab.benches.iterate.runs.clip import alongside, configuration, each, place_at, place_of
from armlab.benches.iterate.runs.commands import (
    AddRun,
    AimAt,
    ChooseMethod,
    RemoveRun,
    SelectRun,
    SetParameter,
    SetStart,
)
from armlab.benches.iterate.runs.examples import ChooseExample
from armlab.benches.iterate.runs.facts import FACTS
from armlab.benches.iterate.runs.job import JOB, todo, with_films
from armlab.benches.iterate.runs.state import Iterations, StartIterations
from armlab.benches.iterate.runs.worked import FLOW, MOST_RUNS
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.ik.iterate import iterate, transpose_flow
from armlab.kin.transforms import transform
from armlab.session.arm_on_clip import standing
from armlab.session.fields import Set
from armlab.session.job import Deliver
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import PlaceTarget
from armlab.session.parts.timeline import OpenClip, Seek, Step, Timeline, duration
from armlab.session.state import apply
from support.clips import another_clip
from support.iterating import done, opened, started

# -- the part --------------------------------------------------------------------------------------------------------


def test_starting_puts_the_film_on_at_its_first_picture_with_the_arm_there():
    state = apply(opened(), StartIterations((0.2, 1.0)))
    assert (state[Timeline].clip, state[Timeline].time, state[Timeline].playing) == ("iterations", 0.0, False)
    np.testing.assert_allclose(state[Joints].q, [0.2, 1.0])
    later = apply(with_films(state), Seek(1.5))
    again = apply(later, StartIterations((-0.5, 0.4)))
    np.testing.assert_allclose(again[Joints].q, [-0.5, 0.4])
    assert again[Timeline].time == 0.0
    np.testing.assert_allclose(with_films(again)[Joints].q, [-0.5, 0.4])


@pytest.mark.parametrize("key", ["planar_2r", "planar_3r", "puma560", "scara", "panda", "cartesian_3p"])
@pytest.mark.parametrize("limits", ["clamp", "none"])
def test_the_films_are_the_iterations_of_the_core(key, limits):
    state = done(
        opened(key), Set(Iterations, "limits", limits), Set(Iterations, "most", 20), AddRun("dls_error"), SetStart()
    )
    part, arm = state[Iterations], state[Joints].arm
    assert len(part.films) == 3
    for run in part.runs:
        trace = iterate(arm, part.target, part.start, run.method, parameters=run.values, most=20, limits=limits)
        film = part.films[run.colour]
        np.testing.assert_array_equal(film.q, trace.q)
        assert (film.status, film.reason) == (trace.status, trace.reason)
        np.testing.assert_allclose(film.way, arm.fk(trace.q)[:, :3, 3], atol=1e-12)
        np.testing.assert_array_equal(film.position_error, trace.position_error)


def test_a_flow_is_a_run_whose_iterates_are_instants():
    state = done(opened(), ChooseMethod(0, FLOW), SetParameter(0, "gain", 2.0), SetParameter(0, "duration", 3.0))
    part = state[Iterations]
    film = part.film
    flow = transpose_flow(state[Joints].arm, part.target, part.start, gain=2.0, duration=3.0, dt=0.05)
    assert film.t[0] == 0.0
    assert film.t[-1] == pytest.approx(flow.t[-1])
    assert (film.status, film.reason) == (flow.status, flow.reason)
    pick = np.searchsorted(flow.t, film.t - 1e-9)
    for name in ("q", "V", "V_dot", "position_error", "components"):
        np.testing.assert_allclose(getattr(film, name), getattr(flow, name)[pick], rtol=1e-12, atol=1e-15)
    assert np.all(np.diff(film.V) <= 0.0)
    assert np.all(film.V_dot <= 0.0)
    reached = done(opened(), ChooseExample("lyapunov"))[Iterations].films[1]
    assert reached.reason == f"at the target after {reached.t[-1]:.2f} s"
    assert 2.0 < reached.t[-1] < 9.0


def test_the_target_of_the_lab_is_followed_and_the_film_is_made_anew():
    state = with_films(opened())
    goal = transform(position=[0.6, 1.1, 0.0])
    moved = apply(state, PlaceTarget(goal))
    np.testing.assert_allclose(moved[Iterations].target[:3, 3], goal[:3, 3])
    assert len(todo(moved).runs) == 2
    assert not todo(with_films(moved))
    # Moving joints, or the film itself, does not touch it.
    assert apply(moved, MoveJoint(0, 0.1))[Iterations].target is moved[Iterations].target


def test_only_what_has_changed_is_made_again():
    state = with_films(opened())
    first = state[Iterations].films
    state = done(state, SetParameter(1, "alpha", 0.2))
    assert state[Iterations].films[0] is first[0]
    assert state[Iterations].films[1] is not first[1]


def test_runs_are_added_copied_and_removed_and_keep_their_colours():
    state = done(opened(), AddRun("ccd"), AddRun(like=1))
    part = state[Iterations]
    assert [run.method for run in part.runs] == ["newton", "gradient", "ccd", "gradient"]
    assert sorted(run.colour for run in part.runs) == list(range(MOST_RUNS))
    with pytest.raises(InputError, match="at most 4 runs"):
        apply(state, AddRun("newton"))
    kept = apply(state, RemoveRun(0))
    assert [run.colour for run in kept[Iterations].runs] == [run.colour for run in part.runs[1:]]
    assert kept[Iterations].run == part.run
    again = apply(kept, AddRun("broyden"))
    assert again[Iterations].run.colour == part.runs[0].colour
    for _ in range(3):
        kept = apply(kept, RemoveRun(0)) if len(kept[Iterations].runs) > 1 else kept
    with pytest.raises(InputError, match="at least one run is needed"):
        apply(kept, RemoveRun(0))


@pytest.mark.parametrize(
    ("command", "says"),
    [
        (SetStart((math.nan, 0.0)), "finite"),
        (SetStart((0.0,)), "start: expected 2 numbers, got 1"),
        (SetStart((1e6, 0.0)), "ten turns"),
        (StartIterations((math.inf, 0.0)), "finite"),
        (AimAt(transform(position=[1e9, 0.0, 0.0])), "farther"),
        (AimAt(np.full((4, 4), np.nan)), "target"),
        (SetParameter(1, "alpha", math.nan), "step size α: expected"),
        (SetParameter(1, "alpha", 1e9), "step size α: expected"),
        (SetParameter(1, "beta", 1.0), "beta"),
        (SetParameter(7, "alpha", 1.0), r"run \(counted from 0\): expected 0 to 1, got 7"),
        (ChooseMethod(0, "magic"), "magic"),
        (Set(Iterations, "most", 0), "most: expected a whole number, at least 1, got 0"),
        (Set(Iterations, "most", 501), "most: expected a whole number, at most 500, got 501"),
        (Set(Iterations, "most", 2.5), "expected a whole number"),
        (Set(Iterations, "most", math.inf), "expected a whole number"),
        (Set(Iterations, "limits", "sometimes"), "sometimes"),
        (SelectRun(2), r"run \(counted from 0\): expected 0 to 1, got 2"),
        (ChooseExample("nothing"), "nothing"),
    ],
)
def test_nonsense_is_refused_in_words(command, says):
    with pytest.raises(InputError, match=says):
        apply(opened(), command)


def test_a_flow_that_is_too_fast_at_first_and_arrives_all_the_same_has_arrived():
    state = done(opened(), ChooseMethod(0, FLOW), SetParameter(0, "gain", 13.0))
    start, target = (-0.65, 0.73), np.asarray(state[Joints].arm.fk([0.25, -1.2]), dtype=float)
    state = done(state, AimAt(target), SetStart(start))
    film = state[Iterations].film
    flow = transpose_flow(state[Joints].arm, target, start, gain=13.0, duration=10.0, dt=0.05)
    assert flow.status == "converged"
    assert (film.status, film.reason) == (flow.status, flow.reason)
    assert film.t[-1] == pytest.approx(flow.t[-1])
    fast = done(state, SetParameter(0, "gain", 60.0))[Iterations].film
    assert fast.status == "unstable"
    assert "the time step is too long for this gain" in fast.reason


def test_the_start_of_which_lessons_know_is_where_the_runs_begin():
    state = done(opened(), SetStart((0.4, 0.9)))
    known = FACTS.facts["start"].value
    assert known(state) == (0.4, 0.9)
    held = done(state, MoveJoint(1, 0.5), LockJoint(1, True))
    assert known(held) == (0.4, 0.5)
    assert tuple(held[Iterations].film.q[0]) == (0.4, 0.5)


def test_a_flow_of_too_many_steps_is_refused():
    state = done(opened(), ChooseMethod(0, FLOW))
    with pytest.raises(InputError, match="400 steps"):
        apply(state, SetParameter(0, "dt", 0.001))


def test_all_joints_locked_and_a_method_that_does_not_fit_say_so():
    locked = done(opened(), LockJoint(0, True), LockJoint(1, True))
    assert [film.status for film in locked[Iterations].films.values()] == ["locked", "locked"]
    one = done(opened(), LockJoint(0, True))
    assert one[Iterations].film.status == "unfit"
    assert "as many joints as task components" in one[Iterations].film.reason
    # A locked joint begins where it stands, whatever the start says.
    moved = done(opened(), MoveJoint(0, 1.0), LockJoint(0, True), SetStart((0.2, 0.3)))
    assert moved[Iterations].films[1].q[0].tolist() == [1.0, 0.3]


# -- the film --------------------------------------------------------------------------------------------------------


def test_every_stop_is_an_iterate_and_the_end_the_last():
    state = started(q=(0.2, 1.0))
    film = state[Iterations].film
    assert film.last >= 3
    for k in range(1, film.last + 1):
        state = apply(state, Step(True))
        assert place_of(state) == (k, 0.0)
        np.testing.assert_allclose(state[Joints].q, standing(state[Joints].arm, film.q[k]), atol=1e-12)
    assert state[Timeline].time == pytest.approx(duration(state))
    back = apply(state, Step(False))
    assert place_of(back) == (film.last - 1, 0.0)


def test_between_iterates_the_arm_rests_and_then_glides_without_whole_turns():
    film = done(opened(), ChooseExample("jump"))[Iterations].film
    assert np.abs(film.step).max() > 2.0 * math.pi
    step = each(film)
    assert place_at(film, 0.3 * step) == (0, 0.0)
    times = np.linspace(0.0, step, 400, endpoint=False)
    q = np.array([configuration(film, place_at(film, float(time))) for time in times])
    assert np.abs(q[-1] - q[0]).max() <= math.pi
    apart = np.abs(2.0 * np.sin(0.5 * (q[-1] - film.q[1])))
    assert apart.max() < 0.02


def test_an_iterate_outside_the_limits_is_shown_turned_into_them_or_at_the_limit():
    arm = catalogue()["planar_2r"].arm
    np.testing.assert_allclose(standing(arm, np.array([3.0 * math.pi / 2.0, 5.0 * math.pi])), [-math.pi / 2, math.pi])
    puma = catalogue()["puma560"].arm
    low, high = puma.limits.T
    rng = np.random.default_rng(1)
    for _ in range(200):
        q = rng.uniform(-12.0, 12.0, 6)
        there = standing(puma, q)
        assert np.all((there >= low) & (there <= high))
        turns = (there - q) / (2.0 * math.pi)
        free = (there > low + 1e-9) & (there < high - 1e-9)
        np.testing.assert_allclose(turns[free], np.round(turns[free]), atol=1e-9)
    inside = rng.uniform(low, high)
    np.testing.assert_array_equal(standing(puma, inside), inside)


def test_closing_puts_the_arm_back_unless_a_hand_has_moved_it():
    state = opened()
    home = state[Joints].q
    film = apply(done(state, StartIterations((0.2, 1.0))), Seek(2.0))
    assert not np.allclose(film[Joints].q, home)
    closed = apply(film, OpenClip(""))
    np.testing.assert_array_equal(closed[Joints].q, home)
    assert closed[Iterations].before is None
    by_hand = apply(apply(film, MoveJoint(0, 0.7)), OpenClip(""))
    assert by_hand[Joints].q[0] == 0.7
    other = apply(film, OpenClip(another_clip(film, "iterations")))
    np.testing.assert_array_equal(other[Joints].q, home)


def test_a_new_film_moves_the_arm_only_where_the_old_one_had_put_it():
    film = apply(started(q=(0.2, 1.0)), Seek(1.0))
    asked = apply(film, SetStart((-0.4, 0.9)))
    np.testing.assert_array_equal(asked[Joints].q, film[Joints].q)
    shown = with_films(asked)
    np.testing.assert_allclose(shown[Joints].q, configuration(shown[Iterations].film, place_of(shown)), atol=1e-12)
    held = with_films(apply(asked, MoveJoint(0, 0.7)))
    assert held[Joints].q[0] == 0.7


def test_other_runs_go_along_by_step_or_by_time():
    state = done(
        opened(), ChooseMethod(0, FLOW), AddRun(FLOW), SetParameter(2, "duration", 5.0), Set(Iterations, "most", 20)
    )
    flow, gradient, short_flow = (state[Iterations].films[run.colour] for run in state[Iterations].runs)
    assert alongside(gradient, (7, 0.25), gradient) == (7, 0.25)
    i, share = alongside(flow, (10, 0.0), short_flow)
    time = short_flow.t[i] + share * (short_flow.t[min(i + 1, short_flow.last)] - short_flow.t[i])
    assert time == pytest.approx(flow.t[10])
    assert alongside(flow, (flow.last, 0.0), gradient) == (gradient.last, 0.0)
    assert alongside(gradient, (gradient.last, 0.0), flow) == (flow.last, 0.0)


def test_selecting_another_run_while_the_film_is_on_shows_its_arm():
    state = apply(started(q=(0.2, 1.0)), Seek(1.0))
    other = apply(state, SelectRun(1))
    film = other[Iterations].films[1]
    np.testing.assert_allclose(other[Joints].q, configuration(film, place_of(other)), atol=1e-12)


# -- the job ---------------------------------------------------------------------------------------------------------


def test_the_job_works_only_while_somebody_looks_and_until_all_is_made():
    state = opened()
    assert JOB.wanted(state, frozenset()) is None
    assert JOB.wanted(state, frozenset({"target"})) is None
    wanted = JOB.wanted(state, frozenset({"iterations"}))
    assert JOB.wanted(state, frozenset({"iterations"})).key == wanted.key
    *_, last = (found for found in JOB.run(wanted.inputs) if found is not None)
    state = apply(state, Deliver(JOB, wanted.inputs, last))
    assert JOB.wanted(state, frozenset({"iterations"})) is None
    assert JOB.wanted(apply(state, Set(Iterations, "most", 3)), frozenset({"iterations"})) is not None
    assert JOB.wanted(apply(opened(), StartIterations((0.0, 1.0))), frozenset()) is not None


def test_a_film_of_another_question_does_no_harm():
    state = opened()
    wanted = JOB.wanted(state, frozenset({"iterations"}))
    found = list(JOB.run(wanted.inputs))[-1]
    other = apply(state, ChooseRobot("puma560"))
    late = apply(other, Deliver(JOB, wanted.inputs, found))
    assert late[Joints].q is other[Joints].q
    assert len(todo(late).runs) == 2
    with_films(late)


def test_a_film_of_another_arm_never_moves_this_one():
    state = apply(started("planar_2r", (0.2, 1.0)), Seek(1.0))
    wanted = JOB.wanted(apply(state, Set(Iterations, "most", 5)), frozenset())
    found = next(found for found in JOB.run(wanted.inputs) if found is not None)
    other = apply(state, ChooseRobot("puma560"))
    late = apply(other, Deliver(JOB, wanted.inputs, found))
    assert late[Joints].q.shape == (6,)
    assert apply(late, Seek(0.5))[Joints].q.shape == (6,)


def test_the_work_on_the_other_runs_goes_on_when_one_film_has_been_delivered():
    state = apply(apply(opened(), AddRun("gradient")), AddRun("dls_constant"))
    panels = frozenset({"iterations"})
    wanted = JOB.wanted(state, panels)
    assert len(wanted.inputs.runs) >= 3
    films = (found for found in JOB.run(wanted.inputs) if found is not None and len(found.films) == 1)
    first = next(films)
    after = apply(state, Deliver(JOB, wanted.inputs, first))
    again = JOB.wanted(after, panels)
    assert len(again.inputs.runs) < len(wanted.inputs.runs)
    assert again.key == wanted.key
    assert JOB.wanted(apply(after, Set(Iterations, "most", 7)), panels).key != wanted.key
    assert JOB.wanted(with_films(after), panels) is None
