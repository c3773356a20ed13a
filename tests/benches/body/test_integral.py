"""The integral of omega: laws of the notes, own ones against small steps, films, fields, facts, and what is refused."""

import json
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from armlab.benches.body.integral.clip import CLIP
from armlab.benches.body.integral.examples import EXAMPLES, ChooseIntegralExample, example_of
from armlab.benches.body.integral.facts import FACTS
from armlab.benches.body.integral.film import angles_over_time, apart, duration_of, film_time, runs_of
from armlab.benches.body.integral.state import (
    CLIP_KEY,
    AddPiece,
    Integral,
    Piece,
    RemovePiece,
    ReverseLaw,
    SetPiece,
)
from armlab.benches.body.integral.ui.page import ends_markup
from armlab.benches.body.integral.ui.scene import shown
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.rotations import axis_angle, skew
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
from armlab.ui.colours import BLUE
from armlab.ui.html import joined
from armlab.ui.units import units_of
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def value(state):
    return {key: fact.now(state).value for key, fact in FACTS.facts.items()}


def said(state):
    return str(joined(ends_markup(state)))


def test_the_laws_of_the_notes_have_equal_integrals_and_end_a_third_of_a_turn_apart():
    state = opened(ChooseIntegralExample("notes"))
    found = value(state)
    np.testing.assert_allclose(np.degrees(found["integral_1"]), [90, 0, 90], rtol=0, atol=1e-12)
    np.testing.assert_allclose(found["integral_2"], found["integral_1"], rtol=0, atol=1e-15)
    assert found["equal"]
    assert math.degrees(found["apart"]) == pytest.approx(120.0, abs=1e-9)
    np.testing.assert_allclose(np.reshape(found["end_1"], (3, 3)), [[0, -1, 0], [0, 0, -1], [1, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(np.reshape(found["end_2"], (3, 3)), [[0, 0, 1], [1, 0, 0], [0, 1, 0]], atol=1e-15)
    assert "Equal integrals, ends 120.0° apart" in said(state)


@pytest.mark.parametrize("about", ["base", "body"])
def test_the_exact_product_is_what_many_small_steps_come_to(about):
    laws = [[[1, 2, -1, 3.0, 0.7], [0, 1, 0, -2.0, 0.5], [1, 0, 1, 0.8, 1.1]], [[0, 0, 1, 1.0, 1.0]]]
    run = runs_of(opened(Set(Integral, "about", about), Set(Integral, "laws", laws)))[0]
    steps, R = 2300, Rotation.identity()
    h = run.duration / steps
    for k in range(steps):
        omega = run.rates[run.piece_at((k + 0.5) * h)]
        small = Rotation.from_rotvec(h * omega)
        R = small * R if about == "base" else R * small
    np.testing.assert_allclose(run.at(run.duration), R.as_matrix(), rtol=0, atol=2e-3)
    # In between it changes as S(omega) says, in the axes in which omega is given.
    t, d = 0.9, 1e-6
    change = (run.at(t + d) - run.at(t - d)) / (2.0 * d)
    S, R = skew(run.rates[1]), run.at(t)
    np.testing.assert_allclose(change, S @ R if about == "base" else R @ S, rtol=0, atol=1e-8)
    np.testing.assert_allclose(R @ R.T, np.eye(3), rtol=0, atol=1e-14)


def test_an_integral_of_zero_leaves_a_rotation_of_second_order():
    for key, size in (("closed", 90.0), ("small", 9.0)):
        found = value(opened(ChooseIntegralExample(key)))
        np.testing.assert_allclose(found["integral_1"], 0.0, rtol=0, atol=1e-15)
        assert found["equal"]
        assert found["angle_2"] == pytest.approx(0.0, abs=1e-12)
        if key == "small":
            assert found["angle_1"] == pytest.approx(math.radians(size) ** 2, rel=0.01)
            # About the axis across both.
            axis, _ = axis_angle(np.reshape(found["end_1"], (3, 3)))
            assert abs(axis[2]) > 0.99


def test_about_one_axis_and_for_the_same_pieces_equal_integrals_end_alike():
    assert "All pieces turn about one line" in said(opened(ChooseIntegralExample("one_axis")))
    same = apply(apply(opened(), ReverseLaw(1)), ReverseLaw(1))
    assert same[Integral].laws[1] == same[Integral].laws[0][::-1]
    alike = opened(Set(Integral, "laws", [opened()[Integral].laws[0]] * 2))
    assert "the bodies end alike" in said(alike)
    assert "The integrals differ by up to 90.0°" in said(apply(alike, SetPiece(0, 0, 3, 0.0)))


def test_a_half_way_example_is_a_third_orientation():
    found = value(opened(ChooseIntegralExample("both_at_once")))
    assert found["equal"]
    assert math.degrees(found["angle_2"]) == pytest.approx(90.0 * math.sqrt(2.0), abs=1e-9)
    assert found["apart"] > 0.1


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_a_number_is_changed(key):
    state = opened(SetPiece(0, 0, 3, 0.1), ChooseIntegralExample(key))
    assert example_of(state) == key
    assert example_of(apply(state, SetPiece(0, 0, 4, 0.33))) == ""


def test_the_film_lasts_as_long_as_the_longer_law_and_stops_where_omega_jumps():
    state = opened(SetPiece(0, 1, 4, 3.0), SetPiece(1, 0, 4, 0.5))
    assert duration_of(state) == CLIP.duration(state) == 4.0
    assert CLIP.stops(state) == (0.5, 1.0, 1.5)
    assert film_time(state) == 4.0
    at = apply(apply(state, OpenClip(CLIP_KEY)), Seek(0.75))
    one, other = runs_of(at)
    assert (one.piece_at(0.75), other.piece_at(0.75)) == (0, 1)
    assert one.turned(0.75) == pytest.approx(0.75 * math.pi / 2)
    np.testing.assert_allclose(other.integral(9.0), other.integral(1.5), rtol=0, atol=0)
    assert "After 0.75 s" in said(at)
    assert "Equal" not in said(at)
    assert shown(one, 0.75, "law 1", BLUE, units_of(at)).about == "ω: 90.0 °/s"
    # The shorter law stands still when it has ended.
    assert shown(other, 1.5, "law 2", BLUE, units_of(at)).about != "ω: 0.0 °/s"
    assert shown(other, 1.75, "law 2", BLUE, units_of(at)).about == "ω: 0.0 °/s"
    assert apply(at, SetPiece(0, 0, 3, 1.0))[Timeline].time == 0.0
    times, (angle, _) = angles_over_time(state)
    assert angle[0] == 0.0
    assert angle[-1] == pytest.approx(float(axis_angle(one.at(4.0))[1]))
    np.testing.assert_array_equal(np.diff(times) > 0.0, True)


def test_omega_jumps_where_a_piece_ends():
    times, omega = runs_of(opened())[0].omega()
    assert times.tolist() == [0.0, 1.0, 1.0, 2.0]
    np.testing.assert_allclose(omega[:, 2], [math.pi / 2, math.pi / 2, 0, 0])


def test_the_axis_of_a_piece_is_carried_along_by_the_body():
    state = opened(ChooseIntegralExample("closed"))
    run = runs_of(state)[0]
    for k in range(4):
        t = k + 0.5
        np.testing.assert_allclose(run.at(t) @ run.at(float(k)).T @ run.axis(t), run.axis(t), rtol=0, atol=1e-12)
    assert apart(state, 0.5) == pytest.approx(0.0, abs=1e-12)


def test_pieces_are_added_and_removed_and_it_is_written_down_and_read_back():
    state = opened(AddPiece(0), RemovePiece(1, 0), SetPiece(0, 2, 0, -2.0))
    part = state[Integral]
    assert [len(law) for law in part.laws] == [3, 1]
    assert part.laws[0][2] == Piece(-2.0, 0.0, 0.0, math.pi / 2, 1.0)
    assert Integral.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetPiece(0, 0, 2, 0.0), "law 1: expected an axis that is not zero"),
        (SetPiece(0, 0, 3, 30.0), "law 1, rate: expected up to 1145.92°/s either way, got 1718.87°/s"),
        (SetPiece(1, 0, 4, 0.0), "law 2, duration: expected 0.01 s to 20 s, got 0 s"),
        (SetPiece(1, 0, 0, float("inf")), "law 2: expected an axis of finite numbers"),
        (SetPiece(1, 2, 0, 1.0), "piece: expected 1 to 2, got 3"),
        (SetPiece(2, 0, 0, 1.0), r"law \(counted from 0\): expected 0 to 1, got 2"),
        (SetPiece(0, 0, 5, 1.0), r"what \(counted from 0\): expected 0 to 4, got 5"),
        (RemovePiece(0, 7), "piece: expected 1 to 2, got 8"),
        (Set(Integral, "laws", [[], [[1, 0, 0, 1, 1]]]), "law 1: expected 1 to 6 pieces, got 0"),
        (Set(Integral, "laws", [[[1, 0, 0, 1]], [[1, 0, 0, 1, 1]]]), "law 1: expected 5 numbers for a piece, got 4"),
        (Set(Integral, "laws", 3), "laws: not usable"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())


def test_the_last_piece_stays_and_there_are_not_too_many():
    with pytest.raises(InputError, match="law 2: expected 1 to 6 pieces, got 0"):
        apply(apply(opened(), RemovePiece(1, 0)), RemovePiece(1, 0))
    state = opened(*[AddPiece(0)] * 4)
    with pytest.raises(InputError, match="law 1: expected 1 to 6 pieces, got 7"):
        apply(state, AddPiece(0))
