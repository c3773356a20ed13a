"""Lessons that put examples in place and look at the planned motion."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.plan import job as jobs_plan
from armlab.benches.motion.plan.commands import AllMovesLike, SetMove
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import JOB, with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJoint, UseShare
from armlab.benches.motion.plan.measured import measuring
from armlab.benches.motion.plan.planning import making
from armlab.benches.motion.plan.points import AddWaypoint, SelectWaypoint
from armlab.benches.motion.plan.seen import seen_motion
from armlab.benches.motion.plan.seen_motion import motion_in
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.content.lessons import lesson
from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.session.bench import benches, choosing, refuse_other_arm, robot_of
from armlab.session.job import Deliver
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.state import State, apply
from armlab.teaching.hand_in import hand_in, judge
from armlab.teaching.lesson_commands import GoToStep, OpenLesson, TakeLessonArm
from armlab.teaching.parts.lesson import LessonPart, check_line, observed
from armlab.teaching.play import Player, problems
from support.done import done
from support.motion_lesson import MOTION
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")
PUMA = catalogue()["puma560"]


def worked(state, panels=frozenset()):
    """Return the state after all that the planning wants, delivered as the lab does."""
    while (wanted := JOB.wanted(state, panels)) is not None:
        for found in JOB.run(wanted.inputs):
            state = state if found is None else apply(state, Deliver(JOB, wanted.inputs, found))
    return state


def to_its_end(state):
    """Return the state with the motion played to its end."""
    state = done(state, OpenClip("motion"))
    return done(state, Seek(duration(state)))


@pytest.fixture(autouse=True, scope="module")
def plans_are_made_once():
    """Remember plans by their question: the players of these tests come to the same motions again and again."""

    @cache
    def made(question):
        return tuple(measuring(making(question)))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(jobs_plan, "making", lambda question: question)
        patch.setattr(jobs_plan, "measuring", made)
        yield


@pytest.fixture
def corners(own):
    own(c=MOTION)
    return done(State.initial(catalogue()["planar_2r"]), OpenLesson("c"))


FLY = (SetMove(1, path="overfly"), AllMovesLike(1))


# --- Examples


@pytest.mark.parametrize("name", [f"{key}/{each}" for key, bench in benches().items() for each in bench.examples])
def test_every_example_of_every_bench_can_be_put_in_place(name):
    key, (bench, chosen) = robot_of(name) or "puma560", name.split("/")
    another = next(each for each in benches()[bench].examples if each != chosen)
    begun = done(State.initial(catalogue()[key]), choosing(f"{bench}/{another}"))
    state = done(begun, choosing(name))
    assert state is not begun
    assert state[RobotPart].robot is (catalogue()[key] if robot_of(name) else begun[RobotPart].robot)
    refuse_other_arm(name, key)


def test_the_benches_come_in_the_order_of_the_course():
    named = ["iterations", "motion", "laws", "curves", "space_curve", "control"]
    assert [key for key in benches() if key in named] == named


def test_names_that_are_not_there_are_refused_with_the_list():
    with pytest.raises(UnknownName, match="bench: unknown name 'moton'; did you mean 'motion'"):
        choosing("moton/circle")
    with pytest.raises(UnknownName, match=r"bench 'motion': unknown name 'circel'.*Available: .*corner_fly"):
        robot_of("motion/circel")
    with pytest.raises(InputError, match="is of the arm 'puma560', not 'scara'"):
        refuse_other_arm("motion/circle", "scara")


def test_opening_puts_the_example_in_place(corners):
    assert corners[Plan].example == "corner_stop"
    assert corners[RobotPart].robot is PUMA
    np.testing.assert_allclose(corners[Joints].q, corners[Plan].waypoints[0].q, rtol=0, atol=1e-12)


def test_steps_put_their_own_examples_in_place_and_others_go_on(corners):
    flown = done(corners, *FLY, GoToStep(1), GoToStep(2))
    assert flown[Plan].moves[0].path.key == "overfly"
    laws = done(flown, GoToStep(3))
    assert laws[Laws].example == "triangle"
    assert laws[LessonPart].bench == "laws"
    assert laws[Plan].moves == flown[Plan].moves
    spline = done(laws, GoToStep(4))
    assert (spline[Plan].example, spline[LessonPart].bench) == ("spline", "motion")
    back = done(spline, GoToStep(1))
    assert (back[Plan].example, back[LessonPart].bench) == ("corner_stop", "motion")


def test_a_lesson_goes_on_with_the_example_of_its_step(corners):
    left = done(corners, GoToStep(4), ChooseRobot("scara"), OpenLesson("t"))
    again = done(left, OpenLesson("c"))
    assert (again[LessonPart].index, again[Plan].example) == (4, "spline")
    changed = done(again, AddWaypoint())
    assert changed[Plan].example == ""
    assert done(changed, TakeLessonArm())[Plan].example == "spline"


def test_an_example_comes_through_the_locks_of_the_lesson(own):
    own(c=MOTION.replace("panel =", 'locked = ["joints", "robot"]\npanel =', 1))
    state = worked(done(State.initial(PUMA), OpenLesson("c"), GoToStep(3), GoToStep(4)))
    assert state[Plan].example == "spline"
    with pytest.raises(InputError, match="keeps the joints"):
        done(state, MoveJoint(0, 1.0))
    played = done(state, OpenClip("motion"), Seek(1.0))
    assert not np.array_equal(played[Joints].q, state[Joints].q)
    shorter = worked(done(played, LastFor(0.5)))
    np.testing.assert_allclose(shorter[Joints].q, planned_now(shorter).motion.at(0.5), rtol=0, atol=1e-9)
    assert shorter[Timeline].time == 0.5


def test_a_lesson_about_motions_does_not_begin_with_an_old_plan(own):
    own(c=MOTION.replace('example = "motion/corner_stop"\n', "", 1))
    before = done(State.initial(PUMA), TakeExample("spline"))
    assert done(before, OpenLesson("c"))[Plan] != before[Plan]
    assert len(done(before, OpenLesson("c"))[Plan].waypoints) == 2
    assert done(done(State.initial(catalogue()["planar_2r"]), AddWaypoint()), OpenLesson("t"))[Plan].moves


def test_an_example_that_is_not_there_keeps_the_lesson_closed(own):
    own(c=MOTION.replace("motion/corner_stop", "motion/corners", 1))
    with pytest.raises(UnknownName, match="did you mean 'corner_"):
        done(State.initial(PUMA), OpenLesson("c"))
    ((_, says),) = [(problem.step, problem.says) for problem in problems("c")]
    assert says.startswith("the lesson cannot be opened: example of the bench 'motion': unknown name 'corners'")


# --- The plan


def test_planning_runs_only_while_a_step_asks_for_it(corners):
    nothing = frozenset({"joints"})
    assert JOB.wanted(corners, nothing) is None
    asked = done(corners, GoToStep(1))
    assert JOB.wanted(asked, nothing) is not None
    assert JOB.wanted(worked(asked), nothing) is None
    assert JOB.wanted(done(asked, GoToStep(3)), nothing) is None
    assert motion_in(observed(done(asked, GoToStep(3)))) is None


def test_planning_goes_on_after_the_check_only_for_a_text(own):
    own(c=MOTION.replace("{{duration}}", "long"), d=MOTION)
    for key, goes_on in (("c", False), ("d", True)):
        state = worked(done(State.initial(PUMA), OpenLesson(key), GoToStep(1), *FLY))
        state = to_its_end(state)
        assert check_line(state)[0]
        closed = done(state, OpenClip(""), UseShare(0.5))
        assert (JOB.wanted(closed, frozenset()) is not None) == goes_on


def test_the_check_looks_again_when_the_plan_is_delivered(corners):
    begun = done(worked(done(corners, GoToStep(2))), LastFor(10.0))
    assert check_line(begun) == (False, "The motion has not been planned yet.")
    assert check_line(worked(begun)) == (True, "")
    fast = worked(done(corners, GoToStep(2), LastFor(1.0)))
    met, says = check_line(fast)
    assert not met
    assert says.startswith("The motion exceeds a limit; within all limits it takes at least ")


def test_what_is_seen_of_a_plan(corners):
    state = worked(done(corners, GoToStep(1), *FLY, UseShare(0.5, 0.25)))
    found, planned = motion_in(observed(state)), planned_now(state)
    assert (found.waypoints, found.planned, found.whole, found.within, found.played) == (5, True, True, True, False)
    assert {(move.space, move.path, move.law) for move in found.moves} == {("cartesian", "overfly", "trapezoidal")}
    assert (found.duration, found.fastest) == (planned.duration, planned.fastest)
    assert found.velocity <= 0.5 + 1e-6
    assert 0.2 < found.acceleration <= 0.25 + 1e-6
    assert found.deviation == planned.legs[0].deviation > 0.0
    assert found.time is None
    short = motion_in(observed(worked(done(state, LastFor(1.0)))))
    assert (short.whole, short.within) == (True, False)
    assert short.acceleration > 1.0


def test_half_an_arc_is_seen_as_the_straight_line_that_it_runs_along():
    state = done(State.initial(PUMA), TakeExample("circle"), SelectWaypoint(2), MoveJoint(0, 1.0), AddWaypoint())
    moves = seen_motion(state, played=False).moves
    assert [move.path for move in moves] == ["circle", "circle", "line"]


def test_a_motion_that_cannot_be_run_says_why(own):
    text = MOTION.replace("puma560", "planar_2r_unequal").replace("motion/corner_stop", "motion/out_of_reach", 1)
    own(c=text.partition("## Laws")[0])
    state = worked(done(State.initial(PUMA), OpenLesson("c"), GoToStep(2)))
    found = motion_in(observed(state))
    assert (found.planned, found.whole, found.within, found.fastest, found.time) == (True, False, False, 0.0, None)
    assert found.trouble == planned_now(state).trouble
    assert check_line(state)[1].startswith("The motion cannot be run to its end: move 1 → 2: ")


def test_a_motion_counts_as_played_only_as_it_is_planned(corners):
    played = to_its_end(worked(done(corners, GoToStep(1), UseShare(0.5, 0.5))))
    assert motion_in(observed(played)).played
    assert motion_in(observed(played)).time == duration(played)
    changed = done(played, *FLY, UseShare(1.0, 1.0))
    assert not motion_in(observed(changed)).played
    # The new plan is shorter: its end comes to where the playback stands, and nobody has seen it.
    delivered = worked(changed)
    assert delivered[Timeline].time == duration(delivered) < duration(played)
    assert not motion_in(observed(delivered)).played
    assert "Play the motion to its end" in check_line(delivered)[1]
    again = to_its_end(done(delivered, Seek(0.0)))
    assert check_line(again)[0]


def test_the_end_of_an_old_motion_is_not_that_of_the_new_one(corners):
    state = worked(done(corners, GoToStep(1)))
    playing = done(state, OpenClip("motion"), Seek(1.0), LastFor(30.0))
    early = done(playing, Seek(duration(playing)))
    assert early[Timeline].time < 30.0
    assert "motion" not in early[LessonPart].progress.films
    assert not motion_in(observed(worked(early))).played


def test_going_to_another_step_forgets_what_was_played(corners):
    state = worked(done(corners, GoToStep(1)))
    played = to_its_end(state)
    assert motion_in(observed(played)).played
    assert not motion_in(observed(done(played, GoToStep(2)))).played


# --- Played by its solution, and handed in


def test_a_lesson_is_done_by_its_solution(own):
    own(c=MOTION)
    assert problems("c") == []


@pytest.mark.parametrize(
    ("old", "new", "step", "says"),
    [
        ('path = "overfly"\n\n[[do]]', 'path = "line"\n\n[[do]]', 2, "has the path “Straight line”"),
        ('\n\n[[do]]\nkind = "motion"', "", 2, "Play the motion to its end."),
        ('name = "motion/corner_stop"', 'name = "motion/corner"', 5, "action 6 of its solution is refused: example of"),
        ("seconds = 10", "seconds = 9", 3, "The motion takes 9.00 s; at least 10.00 s is required."),
        ("at_least_s = 10\nat_most_s = 10\n", "", 3, "its check is met already when the step begins"),
        ("to = 3\nlaw", "to = 9\nlaw", 5, "action 9 of its solution is refused: waypoint: expected 1 to 6, got 9"),
        (
            '"motion/spline"',
            '"motion/joint_or_line"',
            5,
            "it cannot be shown: the example 'motion/joint_or_line' is of",
        ),
    ],
)
def test_what_is_wrong_with_a_solution_is_told(own, old, new, step, says):
    text = MOTION[: MOTION.rindex(old)] + new + MOTION[MOTION.rindex(old) + len(old) :]
    own(c=text)
    assert any(problem.step == step and says in problem.says for problem in problems("c"))


def test_the_work_can_be_handed_in_and_is_judged_again(own):
    own(c=MOTION)
    found = lesson("c")
    player = Player(found)
    for i, step in enumerate(found.steps):
        assert player.go_to(i) == ""
        assert [player.act(action) for action in step.solution] == [""] * len(step.solution)
    text = hand_in(player.session.state)
    assert (judge(text).passed, judge(text).count) == (4, 4)
    assert [step.noted for step in judge(text).steps] == [False, True, False, True, False]
    assert judge(text).steps[1].says == "Recorded only, not judged: that the motion was played."

    def forged(step, **changes):
        data = json.loads(text)
        data["progress"]["evidence"][step] |= changes
        return judge(json.dumps(data))

    seen = json.loads(text)["progress"]["evidence"]["Slowly"]
    # What the file says of the motion is worth nothing; what it was planned of decides.
    assert forged("Slowly", motion={**seen["motion"], "duration": 3.0, "whole": False}).passed == 4
    report = forged("Slowly", plan={**seen["plan"], "duration": 12.0})
    assert report.passed == 3
    assert report.steps[2].says == "The motion takes 12.00 s; at most 10.00 s is required."
    fast = [100.0 * v for v in seen["plan"]["velocity"]]
    assert (
        "limit of velocity of joint 1 was raised"
        in forged("Slowly", plan={**seen["plan"], "velocity": fast}).steps[2].says
    )
    assert "what it is planned of is missing" in forged("Slowly", plan=None).steps[2].says
    for plan in (3, [], {"waypoints": []}, {**seen["plan"], "more": 1}, {**seen["plan"], "samples": 1e9}):
        says = forged("Slowly", plan=plan).steps[2].says
        assert "not usable" in says
        assert says.endswith(".")


def test_a_limit_that_was_raised_counts_neither_on_screen_nor_in_the_file(corners):
    limits = corners[Plan].velocity
    state = worked(done(corners, GoToStep(2), LimitJoint(0, "velocity", 2.0 * limits[0])))
    assert "joint 1 was raised" in check_line(state)[1]
    assert not motion_in(observed(state)).runs
    state = worked(done(state, LimitJoint(0, "velocity", limits[0])))
    assert "was raised" not in check_line(state)[1]


def test_a_player_who_does_not_plan_is_told_so(own):
    own(c=MOTION)
    player = Player(lesson("c"), planning=False)
    player.go_to(2)
    assert planned_now(player.session.state) is None
    assert planned_now(with_planned(player.session.state)) is not None


def test_a_plan_of_another_state_is_not_seen(corners):
    state = worked(done(corners, GoToStep(2)))
    stale = state.replace(replace(state[Plan], duration=5.0))
    assert not motion_in(observed(stale)).planned
    assert motion_in(observed(stale)).waypoints == 5
