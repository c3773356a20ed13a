"""The page of turning without a page: rates and omega, two time laws, small turns, commands, bad input."""

import json
import math

import numpy as np
import pytest

from armlab.benches.velocity.speeds.commands import SetSpeed
from armlab.benches.velocity.turning.commands import SetTurning, TakeToolAngles, WriteAngles
from armlab.benches.velocity.turning.motion import (
    LAWS,
    between,
    commuting,
    law_integral,
    law_rotation,
    laws_time,
    tool_angles_of,
    turned_of,
)
from armlab.benches.velocity.turning.state import Turning
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotations import rotation_from_sequence
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.state import State, apply
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def typed(angles, rates):
    given = [("angles", k, value) for k, value in enumerate(angles)] + [
        ("rates", k, value) for k, value in enumerate(rates)
    ]
    return [SetTurning(what, k, float(value)) for what, k, value in given]


def test_the_numbers_of_the_notes(truth):
    case = truth["C5.1-T-rpy-xyz"]
    found = turned_of(opened(*typed(case["inputs"]["angles"], case["inputs"]["rates"])))
    np.testing.assert_allclose(found.T, case["expected"]["T"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(found.omega, case["expected"]["omega"], rtol=0, atol=case["tol"])
    assert found.determinant == pytest.approx(case["expected"]["det"], abs=case["tol"])
    # With the rotation matrix in place of T, as 5.43 is worded, it is something else.
    wrong = case["printed_value_if_wrong"]["omega_if_T_is_R"]
    assert np.linalg.norm(found.omega - wrong) > 0.5


@pytest.mark.parametrize("axes", SEQUENCES)
@pytest.mark.parametrize("fixed", [False, True])
def test_omega_is_that_of_the_rotation_and_stays_when_the_angles_are_written_otherwise(axes, fixed):
    start = opened()
    before = turned_of(start)
    state = apply(start, WriteAngles(axes, fixed))
    found = turned_of(state)
    np.testing.assert_allclose(found.R, before.R, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.omega, before.omega, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.measured, found.omega, rtol=0, atol=1e-8)
    assert found.determinant == pytest.approx(float(np.linalg.det(found.T)), abs=1e-12)


def test_at_a_singular_angle_the_rates_stay_as_they_are():
    state = opened(*typed((0.3, 0.0, 0.2), (0.1, 0.2, 0.3)))
    rates = state[Turning].rates
    state = apply(opened(*typed((0.0, 0.0, 0.4), rates)), WriteAngles("zxz", False))
    assert abs(turned_of(state).determinant) < 1e-6
    np.testing.assert_allclose(state[Turning].rates, rates)
    assert np.isfinite(turned_of(state).omega).all()


def test_the_film_grows_the_angles_with_their_rates():
    state = apply(opened(OpenClip("turning")), Seek(2.0))
    part = state[Turning]
    expected = np.array(part.angles) + 2.0 * np.array(part.rates)
    np.testing.assert_allclose(turned_of(state).angles, expected)
    R = rotation_from_sequence(part.axes, expected, fixed=part.fixed)
    np.testing.assert_allclose(turned_of(state).R, R, rtol=0, atol=1e-14)
    # A typed angle, another sequence, and another view begin anew.
    for command in (SetTurning("angles", 0, 1.0), WriteAngles("zyz"), Set(Turning, "shown", "laws"), TakeToolAngles()):
        assert apply(state, command)[Timeline].time == 0.0


def test_equal_integrals_lead_to_different_orientations():
    """Notes 5.19-5.21."""
    one, other = (law_integral(2.0, law) for law in range(2))
    np.testing.assert_allclose(np.degrees(one), [90, 0, 90], rtol=0, atol=1e-12)
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-15)
    assert between(law_rotation(0, 2.0), law_rotation(1, 2.0)) == pytest.approx(math.radians(120.0), abs=1e-12)
    for law, pieces in enumerate(LAWS):
        # Each piece turns about axes that stay.
        np.testing.assert_allclose(law_rotation(law, 1.0) @ pieces[0], pieces[0], rtol=0, atol=1e-15)
    state = apply(opened(Set(Turning, "shown", "laws")), OpenClip("turning"))
    assert duration(state) == 2.0
    assert laws_time(state) == 0.0
    assert laws_time(opened()) == 2.0
    np.testing.assert_allclose(law_rotation(0, 0.0), np.eye(3))


def test_small_turns_commute_to_the_second_order():
    found = commuting()
    assert [each.size for each in found] == [0.1, 0.01, 0.001]
    for each in found:
        assert 0.9 * each.size**2 < each.apart < 1.3 * each.size**2
        assert 0.9 * each.size**2 < each.from_sum < 1.3 * each.size**2


def test_the_angles_of_the_tool():
    state = opened(TakeToolAngles())
    np.testing.assert_allclose(turned_of(state).R, state[Joints].tool_pose[:3, :3], rtol=0, atol=1e-12)


def test_the_rates_of_the_tools_angles(truth):
    """Notes 5.49-5.51: of the 2R phidot = q1dot + q2dot."""
    state = State.initial(catalogue()["planar_2r"])
    for command in (WriteAngles("zyx", False), SetSpeed(0, 0.3), SetSpeed(1, -0.2)):
        state = apply(state, command)
    found = tool_angles_of(state)
    np.testing.assert_allclose(found.J, [[1, 1], [0, 0], [0, 0]], rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.rates, [0.1, 0, 0], rtol=0, atol=1e-12)
    # With zxz the planar arm stands at a singular orientation.
    singular = tool_angles_of(apply(state, WriteAngles("zxz")))
    assert singular.J is None
    np.testing.assert_allclose(singular.omega, [0, 0, 0.1], rtol=0, atol=1e-12)


def test_the_rates_of_the_tools_angles_give_its_omega():
    state = opened(WriteAngles("zyz", False))
    found = tool_angles_of(state)
    T = turned_of(apply(state, TakeToolAngles())).T
    np.testing.assert_allclose(T @ found.rates, found.omega, rtol=0, atol=1e-9)


def test_it_is_written_down_and_read_back():
    part = opened(WriteAngles("zyz", False), Set(Turning, "shown", "laws"))[Turning]
    assert Turning.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("name", "value"),
    [("axes", "zzz"), ("shown", "all"), ("angles", [1, 2]), ("rates", [0, 0, float("inf")]), ("angles", [1e6, 0, 0])],
)
def test_damaged_files_are_refused(name, value):
    data = {**Turning().to_json(), name: value}
    with pytest.raises((InputError, ValueError)):
        Turning.from_json(data, catalogue()["puma560"])


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetTurning("angles", 3, 0.0), r"angles \(counted from 0\): expected 0 to 2, got 3"),
        (SetTurning("speeds", 0, 0.0), "speeds"),
        (SetTurning("rates", 1, float("nan")), "rates: expected finite numbers"),
        (WriteAngles("zzx"), "zzx"),
        (Set(Turning, "shown", "none"), "none"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


def test_rates_that_would_be_too_large_stay_as_they_are():
    state = opened(*typed((0.0, 1e-4, 0.4), (3.0, 2.0, 1.0)))
    found = apply(state, WriteAngles("zxz", False))
    assert found[Turning].axes == "zxz"
    assert found[Turning].rates == state[Turning].rates
    np.testing.assert_allclose(turned_of(found).R, turned_of(state).R, rtol=0, atol=1e-9)
