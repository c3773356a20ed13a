"""Views of the page Quaternions: algebra, the quaternion of R by three methods, and three ways between two."""

import json
import math

import numpy as np
import pytest

from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis, SetWholeQuaternion
from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.quaternion.between import DURATION, film_share, present_way, speeds, turned_in_all, ways_of
from armlab.benches.body.quaternion.clip_way import CLIP
from armlab.benches.body.quaternion.facts import FACTS
from armlab.benches.body.quaternion.film import present, present_turn, second
from armlab.benches.body.quaternion.from_matrix import found_of
from armlab.benches.body.quaternion.state import Quaternions
from armlab.benches.body.quaternion.state_view import WAY_KEY, WAYS, QuaternionView
from armlab.benches.body.quaternion.ui.algebra import _verdict, inverse_markup
from armlab.benches.body.quaternion.ui.page import ENDS, TURNS
from armlab.benches.body.quaternion.ui.scene_way import circles, hands_of, tips, traces_of
from armlab.benches.body.quaternion.ui.way import _said, _table
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.quaternions import exponential, product
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["planar_2r"]), *commands)


def view(shown, *commands):
    return opened(Set(QuaternionView, "shown", shown), *commands)


def between(key, *commands):
    _, p, q = ENDS[key]
    return view("way", Set(Quaternions, "p", p), SetWholeQuaternion(q), *commands)


def value(state):
    return {key: fact.now(state).value for key, fact in FACTS.facts.items()}


def test_the_algebra_is_that_of_the_body():
    state = view("algebra", SetWholeAxis((0.0, 0.0, 1.0)), SetBodyTurn(math.pi / 2))
    np.testing.assert_allclose(present(state), forms_of(state).q, rtol=0, atol=0)
    axis, angle = present_turn(state)
    np.testing.assert_allclose(angle * axis, [0, 0, math.pi / 2], rtol=0, atol=1e-15)
    found = value(state)
    np.testing.assert_allclose(found["inverse"], [math.sqrt(0.5), 0, 0, -math.sqrt(0.5)], rtol=0, atol=1e-15)
    np.testing.assert_allclose(found["logarithm"], [0, 0, 0, math.pi / 4], rtol=0, atol=1e-15)
    np.testing.assert_allclose(product(forms_of(state).q, found["inverse"]), [1, 0, 0, 0], rtol=0, atol=1e-15)
    np.testing.assert_allclose(exponential(found["logarithm"]), forms_of(state).q, rtol=0, atol=1e-15)
    assert "q q⁻¹ = 1" in str(joined(inverse_markup(state)))


@pytest.mark.parametrize(
    ("key", "told", "wrong"),
    [
        ("third", "A wrong index gives another rotation", {"slip"}),
        ("half", "Roots and signs fail here", {"signs", "slip"}),
        ("nearly", "Roots and signs fail here", {"signs", "slip"}),
    ],
)
def test_the_methods_that_fail_are_named(key, told, wrong):
    state = view("matrix", *TURNS[key][1])
    found = found_of(state)
    assert {name for name, each in found.items() if each.off > 1e-9} == wrong
    assert found["largest"].off < 1e-15
    assert told in _verdict(state)
    facts = value(state)
    assert facts["signs_off"] == found["signs"].off
    assert facts["largest_off"] == found["largest"].off


def test_no_rotation_and_one_on_which_the_slip_is_not_seen():
    assert "Without a rotation all agree" in _verdict(view("matrix", SetBodyTurn(0.0)))
    assert "The slip is not seen here: both signs are the same" in _verdict(view("matrix"))
    for axis in ((1.0, 0.0, 0.0), (1.0, 0.0, 3.0), (2.0, 0.0, -1.0), (3.0, 0.0, 1.0)):
        across_y = view("matrix", SetWholeAxis(axis), SetBodyTurn(1.0))
        assert "The slip is not seen here: y is zero" in _verdict(across_y)


def test_every_way_begins_at_p_and_ends_at_q():
    for key in ("wander", "far", "half"):
        state = between(key)
        p, q = second(state), forms_of(state).q
        for way in ways_of(state).by.values():
            for s, end in ((0.0, p), (1.0, q)):
                np.testing.assert_allclose(way.rotation(s), rotation_from_quaternion(end), rtol=0, atol=1e-7)


@pytest.mark.parametrize("shorter", [True, False])
@pytest.mark.parametrize("key", ["wander", "far"])
def test_slerp_turns_as_its_omega_says(key, shorter):
    state = between(key, Set(QuaternionView, "shorter", shorter))
    h = 1e-6
    for way in ways_of(state).by.values():
        omega = way.angular(0.4)[0]
        S = (way.rotation(0.4 + h) - way.rotation(0.4 - h)) / (2 * h) @ way.rotation(0.4).T
        np.testing.assert_allclose([S[2, 1], S[0, 2], S[1, 0]], omega, rtol=0, atol=1e-7)


def test_three_angles_turn_further_and_lerp_is_faster_in_its_middle():
    state = between("wander")
    found = {key: turned_in_all(state, key) for key in WAYS}
    assert found["slerp"] == pytest.approx(found["line"], rel=1e-6)
    assert found["euler"] > 2.5 * found["slerp"]
    s, speed = speeds(state)
    assert np.ptp(speed["slerp"]) < 1e-12
    assert s[np.argmax(speed["line"])] == pytest.approx(0.5, abs=0.01)
    assert speed["line"].max() / found["line"] > 1.05
    assert "Three angles turn further" in _said(state)
    assert "Euler angles ZYX" in _table(state)


def test_about_the_axis_of_one_angle_three_angles_turn_no_further():
    from_none = Set(Quaternions, "p", (1.0, 0.0, 0.0, 0.0))
    about_z = view("way", from_none, SetWholeQuaternion((math.cos(0.5), 0.0, 0.0, math.sin(0.5))))
    assert turned_in_all(about_z, "euler") == pytest.approx(turned_in_all(about_z, "slerp"))
    assert "Here the three angles turn about the same axis" in _said(about_z)
    assert "nothing turns" in _said(view("way", from_none, SetWholeQuaternion((1.0, 0.0, 0.0, 0.0))))


def test_the_shorter_way_is_to_minus_q_where_that_is_nearer():
    state = between("far")
    assert math.degrees(turned_in_all(state, "slerp")) == pytest.approx(120.0)
    assert "nearer" in _said(state)
    long = apply(state, Set(QuaternionView, "shorter", False))
    assert math.degrees(turned_in_all(long, "slerp")) == pytest.approx(240.0)
    assert math.degrees(turned_in_all(long, "line")) == pytest.approx(240.0)
    assert "the long way round" in _said(long)
    assert value(long)["slerp_turned"] == pytest.approx(math.radians(240.0))


def test_half_a_turn_apart_and_q_opposite_to_p_are_said():
    assert "half a turn apart" in _said(between("half"))
    same = between("same")
    assert turned_in_all(same, "slerp") == pytest.approx(0.0, abs=1e-12)
    long = apply(same, Set(QuaternionView, "shorter", False))
    assert "line" not in ways_of(long).by
    assert "there is no lerp" in _said(long)
    assert math.degrees(turned_in_all(long, "slerp")) == pytest.approx(360.0)
    assert turned_in_all(long, "line") is None
    way = ways_of(long).by["slerp"]
    h = 1e-6
    S = (way.rotation(0.3 + h) - way.rotation(0.3 - h)) / (2 * h) @ way.rotation(0.3).T
    np.testing.assert_allclose([S[2, 1], S[0, 2], S[1, 0]], way.angular(0.3)[0], rtol=0, atol=1e-6)
    # The body takes slerp where lerp is asked for and is not there.
    asked = apply(long, Set(QuaternionView, "way", "line"))
    assert present_way(asked) is ways_of(asked).by["slerp"] or isinstance(present_way(asked), type(way))


def test_the_film_goes_from_p_to_q():
    state = between("wander")
    assert CLIP.duration(state) == DURATION
    assert film_share(state) == 0.5
    at = apply(apply(state, OpenClip(WAY_KEY)), Seek(1.0))
    assert film_share(at) == 0.25
    expected = ways_of(at).by["slerp"].rotation(0.25)
    np.testing.assert_allclose(np.reshape(value(state)["on_the_way"], (3, 3)), ways_of(state).by["slerp"].rotation(0.5))
    np.testing.assert_allclose(present_way(at).rotation(film_share(at)), expected, rtol=0, atol=1e-15)


def test_the_traces_are_those_of_the_tip_of_the_z_axis():
    state = between("wander")
    centre = np.array([1.0, 2.0, 3.0])
    strokes = traces_of(state, centre, 0.5).strokes
    assert len(strokes) == 3 * 120
    np.testing.assert_allclose([np.linalg.norm(end - centre) for _, end, _ in strokes], 0.5, rtol=0, atol=1e-12)
    p = rotation_from_quaternion(second(state))
    np.testing.assert_allclose(tips(present_way(state), np.array([0.0]))[0], p[:, 2], rtol=0, atol=1e-12)
    assert len(hands_of(state, 0.3, centre, 0.5).arrows) == 3
    assert len(circles(centre, 0.5).strokes) == 108


def test_it_is_written_down_and_read_back():
    part = between("half", Set(QuaternionView, "way", "euler"), Set(QuaternionView, "shorter", False))[QuaternionView]
    assert QuaternionView.from_json(json.loads(json.dumps(part.to_json())), catalogue()["puma560"]) == part


@pytest.mark.parametrize(("name", "wrong"), [("shown", "all"), ("way", "bus"), ("shorter", "yes")])
def test_what_cannot_be_is_refused_in_words(name, wrong):
    with pytest.raises(InputError, match=f"{name}"):
        Set(QuaternionView, name, wrong).apply(opened())
