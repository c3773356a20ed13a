"""The lessons of inverse kinematics against the kinematics of the lab, and the check of what a student computes."""

import numpy as np
import pytest

from armlab.benches.iterate.runs.examples import EXAMPLES, ChooseExample
from armlab.benches.iterate.runs.state import Iterations
from armlab.content.actions import Move
from armlab.content.lessons import lesson, lessons, parse_lesson
from armlab.content.observation import Observation
from armlab.content.robots import catalogue
from armlab.content.rows import rows
from armlab.errors import ContentError
from armlab.kin.ik.iterate import iterate, newton_1d
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.transforms import transform
from armlab.session.parts.target import PlaceTarget
from armlab.session.session import Session
from armlab.teaching.lesson_commands import GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart, check_line

VARIANTS = range(4)


def check_of(key, step, variant=0):
    return lesson(key, variant).steps[step - 1].check.check


def answer_of(key, step, variant=0):
    return lesson(key, variant).steps[step - 1].question.answer


def moved(key, step, variant=0):
    """Return where the solution of a step brings the arm."""
    return next(act.q for act in lesson(key, variant).steps[step - 1].solution if isinstance(act, Move))


def same_angles(one, other):
    return np.abs(np.remainder(np.subtract(one, other) + np.pi, 2 * np.pi) - np.pi).max()


def solutions_at(arm, q):
    return solve_all(arm, arm.fk(np.asarray(q)))


def test_every_row_on_inverse_kinematics_is_taught():
    asked = {key for key, row in rows().items() if row.section.startswith(("4.3", "4.4"))}
    taught = {row for each in lessons().lessons.values() for row in each.teaches}
    assert len(asked) == 17
    assert asked <= taught


# --- Closed forms: the steps of a lesson bring the arm to different solutions for one point


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize(("key", "steps", "all_of_them"), [("ik_2r", (2, 3), 2), ("ik_polar", (1, 2, 3, 4), 4)])
def test_the_steps_of_a_closed_form_go_through_all_solutions(key, steps, all_of_them, variant):
    arm = lesson(key, variant).robot_used.arm
    visited = [moved(key, step, variant) for step in steps]
    found = solutions_at(arm, visited[0])
    assert (len(found), found.completeness) == (all_of_them, "complete")
    for q in visited:
        np.testing.assert_allclose(arm.position(q), arm.position(visited[0]), rtol=0, atol=1e-9)
        assert min(same_angles(q, row) for row in found.q) < 1e-9
    assert min(same_angles(a, b) for i, a in enumerate(visited) for b in visited[:i]) > 0.1


@pytest.mark.parametrize("variant", VARIANTS)
def test_three_of_the_four_solutions_of_the_elbow_and_the_one_it_tells(variant):
    arm = lesson("ik_elbow", variant).robot_used.arm
    visited = [moved("ik_elbow", step, variant) for step in (2, 3, 4)]
    found = solutions_at(arm, visited[0])
    assert len(found) == 4
    left = [row for row in found.q if min(same_angles(row, q) for q in visited) > 1e-6]
    assert len(left) == 1
    # As the reveal of step 4 says: back, and mirrored from elbow down in front.
    front, down, _ = visited
    mirrored = [front[0] - np.pi, np.pi - down[1], front[2]]
    assert same_angles(left[0], mirrored) < 1e-6


def test_the_handle_of_a_lesson_is_where_its_steps_lead():
    for key in ("ik_2r", "ik_polar", "ik_elbow"):
        found = lesson(key, 2)
        step = 1 if key == "ik_polar" else 2
        np.testing.assert_allclose(
            found.target[:3, 3], found.robot_used.arm.position(moved(key, step, 2)), rtol=0, atol=1e-9
        )


@pytest.mark.parametrize("variant", VARIANTS)
def test_both_angles_of_the_bent_link_are_at_the_height_asked(variant):
    arm = lesson("tan_half", variant).robot_used.arm
    first, second = (arm.position(moved("tan_half", step, variant))[1] for step in (3, 4))
    assert abs(first - second) < 1e-12
    below = np.radians(answer_of("tan_half", 5, variant))
    height = arm.position(np.array([np.pi]))[1]
    assert abs(arm.position(np.array([below]))[1] - height) < 1e-12
    top = answer_of("tan_half", 6, variant)
    assert abs(arm.position(moved("tan_half", 6, variant))[1] - top) < 1e-12
    assert arm.position(np.linspace(-np.pi, np.pi, 999)[:, None])[:, 1].max() <= top


# --- Numbers of solutions that are asked for


@pytest.mark.parametrize(("key", "count", "asked"), [("ik_cases", 8, 8), ("ik_ur10", 8, 8), ("ik_sixteen", 16, 8)])
def test_the_number_that_is_counted_in_the_list_is_that_of_the_arm(key, count, asked):
    found = solutions_at(lesson(key).robot_used.arm, lesson(key).start)
    assert (len(found), found.completeness) == (count, "complete")
    # The title of one lesson tells its 16, so the different values of joint 1 are counted there.
    rows_asked = np.unique(np.round(found.q[:, 0], 6)) if key == "ik_sixteen" else found.q
    assert answer_of(key, 1) == asked == len(rows_asked)
    # The row that the step sends to is one of them.
    assert min(same_angles(moved(key, 1), row) for row in found.q) < 1e-5


def test_six_of_the_eight_of_the_puma_are_inside_its_limits():
    found = solutions_at(lesson("ik_cases").robot_used.arm, lesson("ik_cases").start)
    assert int(found.within_limits.sum()) == 6


@pytest.mark.parametrize(("key", "step"), [("ik_cases", 2), ("ik_ur10", 4), ("ik_elbow", 5)])
def test_singular_places_with_infinitely_many_solutions(key, step):
    arm, q = lesson(key).robot_used.arm, np.array(moved(key, step))
    T = np.array(arm.fk(q))
    if key == "ik_elbow":
        T = transform(position=[0, 0, 1.4])
    assert solve_all(arm, T).completeness == "infinite"


def test_home_of_the_arm_with_sixteen_has_four():
    assert len(solutions_at(lesson("ik_sixteen").robot_used.arm, moved("ik_sixteen", 3))) == 4


def test_no_solution_with_the_hand_up_and_some_with_the_hand_forward():
    arm = catalogue()["puma560"].arm
    up = check_of("ik_cases", 3).goal.position
    assert solve_all(arm, transform(position=up)).completeness == "none"
    forward = transform(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], dtype=float), up)
    assert len(solve_all(arm, forward)) > 0


# --- Iterations: the steps a student computes are those of the lab


def one_step(key, method, **parameters):
    found = lesson(key)
    arm = found.robot_used.arm
    return iterate(arm, found.target, found.start, method, parameters=parameters or None, task="xy", most=6)


def test_the_step_of_newton():
    trace = one_step("newton_arm", "newton")
    assert same_angles(check_of("newton_arm", 2).q, trace.q[1]) < np.radians(0.01)
    assert same_angles(moved("newton_arm", 3), trace.q[-1]) < np.radians(0.001)
    np.testing.assert_allclose(trace.position_error[:4], [0.224, 0.0211, 0.00025, 4e-8], rtol=0.05)
    other = solve_all(lesson("newton_arm").robot_used.arm, lesson("newton_arm").target)
    assert min(same_angles(moved("newton_arm", 4), row) for row in other.q) < np.radians(0.001)


def test_the_step_of_the_pseudo_inverse():
    trace = one_step("newton_redundant", "newton")
    assert same_angles(check_of("newton_redundant", 2).q, trace.q[1]) < np.radians(0.01)
    np.testing.assert_allclose(trace.position_error[:3], [0.5, 0.065, 0.002], rtol=0.05)


def test_the_step_of_the_gradient_and_its_bound():
    trace = one_step("gradient", "gradient", alpha=0.5)
    assert same_angles(check_of("gradient", 1).q, trace.q[1]) < np.radians(0.01)
    arm = lesson("gradient").robot_used.arm
    sigma = np.linalg.svd(arm.jacobian(moved("gradient", 3))[:2], compute_uv=False)
    assert abs(answer_of("gradient", 3) - 2 / sigma[0] ** 2) < 1e-3
    np.testing.assert_allclose(sigma, [1.84, 0.51], atol=0.005)


def test_the_steps_with_one_joint():
    def slope(q):
        return -np.sin(q)

    iterates = [step.x for step in newton_1d(lambda q: np.cos(q) - 0.5, slope, float(lesson("newton_1d").start[0]))]
    assert abs(check_of("newton_1d", 3).q[0] - iterates[1]) < np.radians(0.001)
    assert abs(check_of("newton_1d", 4).q[0] - iterates[2]) < np.radians(0.001)
    errors = np.degrees(np.abs(np.array(iterates[:5]) - np.pi / 3))
    np.testing.assert_allclose(errors[:4], [31.35, 13.77, 0.61, 0.0018], rtol=0.03)
    assert 1e-8 < errors[4] < 3e-8


# --- The check of values that are to be computed

FRONT = """+++
title = "A lesson"
chapter = "4 Made up"
teaches = ["S4.3.3-ik-2R"]
robot = "planar_3r"
+++

## Find it

```check
kind = "joints_found"
q_deg = [33.3, -47.7, 20.2]
tolerance_deg = 1
```
"""


@pytest.fixture(scope="module")
def found():
    return parse_lesson("made_up", FRONT).steps[0].check.check


def seen(*q_deg):
    return Observation.of(catalogue()["planar_3r"].arm, np.radians(q_deg))


@pytest.mark.parametrize(
    ("q_deg", "says"),
    [
        ((0, 0, 0), "No joint is where it should be yet."),
        ((33, 0, 0), "Joint 1 is right, joints 2 and 3 are not yet."),
        ((33, -48, 0), "Joints 1 and 2 are right, joint 3 is not yet."),
        ((33, 47.7, 20), "Joints 1 and 3 are right, joint 2 is not yet. The sign is wrong: positive angles"),
        ((0.581, 0, 0), "No joint is where it should be yet. That is the number of radians, taken for degrees."),
        ((-33.3, 47.7, -20.2), "All joint values have the right size and the wrong sign."),
    ],
)
def test_values_to_be_found_are_not_told(found, q_deg, says):
    assert not found.is_met(seen(*q_deg))
    assert found.says(seen(*q_deg)).startswith(says)
    for value in ("33", "47", "20"):
        assert value not in found.says(seen(*q_deg))


def test_values_that_are_found(found):
    assert found.is_met(seen(33, -48, 20))
    assert found.says(seen(33, -48, 20)) == "All joints are where they should be."
    assert not found.is_met(seen(33, -48, 22))


def test_its_fields_are_checked_as_those_of_joints_at():
    with pytest.raises(ContentError, match="q_deg: outside the joint limits of Planar 3R"):
        parse_lesson("made_up", FRONT.replace("33.3", "333"))


# --- In the lab


@pytest.mark.parametrize("key", ["ik_2r", "newton_arm", "ik_polar", "ik_cases"])
def test_a_lesson_opens_whatever_arm_is_on_the_table(key):
    session = Session.fresh("student", catalogue()["ur5e"])
    session.apply(OpenLesson(key), 0.0)
    assert session.notice is None
    assert session.state[LessonPart].lesson.key == key


@pytest.mark.parametrize("key", ["newton_arm", "gradient"])
def test_the_examples_that_a_lesson_names_are_there_and_not_locked(key):
    html = " ".join("".join(step.html + step.reveal_html for step in lesson(key).steps).split())
    named = [example.key for example in EXAMPLES.values() if f"<em>{example.title}</em>" in html]
    assert len(named) == {"newton_arm": 1, "gradient": 3}[key]
    session = Session.fresh("student", lesson(key).robot_used)
    session.apply(OpenLesson(key), 0.0)
    for example in named:
        session.apply(ChooseExample(example), 1.0)
        assert session.notice is None
        assert session.state[Iterations].example == example


@pytest.mark.parametrize(("key", "step", "position"), [("ik_2r", 5, [1.8, 0, 0]), ("ik_elbow", 5, [0, 0, 1.4])])
def test_a_target_typed_as_the_step_says_meets_its_check(key, step, position):
    session = Session.fresh("student", lesson(key).robot_used)
    session.apply(OpenLesson(key, variant=0), 0.0)
    session.apply(GoToStep(step - 1), 1.0)
    assert not check_line(session.state)[0]
    session.apply(PlaceTarget(transform(position=position)), 2.0)
    assert check_line(session.state)[0]
