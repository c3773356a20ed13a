"""The page of harmonic drives: what turns which way, what is counted, and what is refused."""

import math

import numpy as np
import pytest

from armlab.benches.drive.gears.stage import stage_of
from armlab.benches.drive.harmonic.clip import CLIP
from armlab.benches.drive.harmonic.examples import EXAMPLES, ChooseHarmonicExample
from armlab.benches.drive.harmonic.facts import FACTS
from armlab.benches.drive.harmonic.film import DURATION, counted, turned_at
from armlab.benches.drive.harmonic.state import TURN, Harmonic, SetCircular, SetSplines, ShowTurns
from armlab.benches.drive.harmonic.ui.page import PANEL
from armlab.benches.drive.harmonic.ui.parts import (
    circular_glb,
    flag_glb,
    generator_glb,
    tooth_of_flexspline,
    tooth_poses,
)
from armlab.benches.drive.harmonic.ui.scene import module_of
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.drive.strain_wave import FIXED, strain_wave
from armlab.session.fields import Set
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import State, apply
from support.done import done


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def value(name, state):
    return FACTS.facts[name].now(state).value


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_changed(key):
    state = opened(ChooseHarmonicExample(key))
    assert state[Harmonic].example == key
    assert apply(state, Set(Harmonic, "names", False))[Harmonic].example == key
    other = "flexible" if state[Harmonic].fixed != "flexible" else "circular"
    assert apply(state, Set(Harmonic, "fixed", other))[Harmonic].example == ""


def test_the_ratio_of_the_notes_with_its_sign_and_the_counted_teeth(truth):
    """Erratum 2.29: -100 with the circular spline fixed, +101 with the flexspline fixed."""
    expected = truth["C2.2-harmonic-200"]["expected"]
    state = opened(ChooseHarmonicExample("notes"))
    assert value("ratio", state) == expected["signed_ratio_CS_fixed"]
    assert value("counted", state) == -2.0
    assert value("ratio", opened(ChooseHarmonicExample("flexible"))) == expected["ratio_FS_fixed"]
    assert (value("flexspline", state), value("circular", state), value("fixed", state)) == (200, 202, "circular")


@pytest.mark.parametrize("fixed", FIXED)
@pytest.mark.parametrize("difference", [2, 3, 4])
def test_a_lobe_comes_past_as_many_teeth_of_one_spline_as_of_the_other(fixed, difference):
    drive = strain_wave(60, difference, fixed)
    for theta in (0.0, 1.3, 2.0 * math.pi):
        found = counted(drive, theta)
        assert found.passed_circular == pytest.approx(found.passed_flexible)
        assert found.turns == pytest.approx(found.out * drive.ratio)
    if fixed != "generator":
        assert counted(drive, 2.0 * math.pi).moved == pytest.approx(
            -difference if fixed == "circular" else -difference * 60 / (60 + difference)
        )


def test_facts_follow_the_film():
    state = opened(ChooseHarmonicExample("sixty"), OpenClip("harmonic"), Seek(TURN))
    assert value("input_turns", state) == pytest.approx(1.0)
    assert value("moved", state) == pytest.approx(-2.0)
    assert value("output_turns", state) == pytest.approx(-1.0 / 30.0)
    assert value("moved", opened()) == 0.0
    assert CLIP.duration(state) == DURATION
    assert CLIP.stops(state) == (6.0, 12.0)
    assert turned_at(TURN) == pytest.approx(2.0 * math.pi)
    assert apply(state, ShowTurns(2))[Timeline].time == 12.0
    assert apply(opened(), ShowTurns(1))[Timeline].clip == "harmonic"
    # Other teeth begin the film anew.
    assert apply(state, Set(Harmonic, "flexspline", 80))[Timeline].time == 0.0


@pytest.mark.parametrize("fixed", FIXED)
def test_the_marked_tooth_is_drawn_where_the_drive_has_it(fixed):
    """At a lobe the flexspline is not shifted along: there its tooth stands at its own angle, as far out as it gets."""
    drive = strain_wave(60, 2, fixed)
    generator, flexible, _ = drive.angles(7.0)
    places, directions = tooth_poses(drive, 7.0)
    own = 2.0 * np.pi * np.arange(60) / 60
    beside = np.abs(np.angle(np.exp(2j * (own + flexible - generator)))) / 2.0
    k = int(np.argmin(beside))
    radius, angle = np.hypot(*places[k]), np.arctan2(places[k, 1], places[k, 0])
    assert radius == pytest.approx(31.0, abs=0.05)
    assert math.remainder(angle - own[k] - flexible, math.tau) == pytest.approx(0.0, abs=0.02 * beside[k] + 1e-3)
    assert math.remainder(directions[k] - angle, math.tau) == pytest.approx(0.0, abs=0.2)


def test_parts_are_as_large_as_the_stage():
    state = opened()
    drive, radius = state[Harmonic].drive, stage_of(state).radius
    assert 0.5 * drive.circular * module_of(drive, radius) < radius
    for glb in (circular_glb(62), generator_glb(drive), flag_glb(60)):
        assert glb[:4] == b"glTF"
    assert len(circular_glb(402)) < 1_200_000
    tooth = tooth_of_flexspline()
    a, b, c = (tooth.vertices[tooth.faces[:, k]] for k in range(3))
    assert float(np.einsum("ki,ki->k", a, np.cross(b, c)).sum()) > 0.0
    corners = PANEL.around(state)
    assert corners.shape == (4, 3)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (Set(Harmonic, "flexspline", 0), "flexspline"),
        (Set(Harmonic, "flexspline", 60.5), "flexspline"),
        (Set(Harmonic, "flexspline", 1000), "flexspline"),
        (SetCircular(61), "expected 2, 3 or 4 more than the 60 of the flexspline, .* got 61"),
        (SetCircular(60), "got 60"),
        (SetSplines(200, 400), "got 400"),
        (ShowTurns(4), "turns: expected 0 to 3, got 4"),
        (Set(Harmonic, "fixed", "nothing"), "nothing"),
        (ChooseHarmonicExample("best"), "best"),
    ],
)
def test_what_cannot_be_is_refused_and_the_old_state_stays(command, told):
    state = opened()
    with pytest.raises(InputError, match=told):
        apply(state, command)
    assert state[Harmonic] == EXAMPLES["sixty"].part


def test_both_splines_can_be_typed():
    assert opened(SetCircular(63))[Harmonic].drive.ratio == pytest.approx(-20.0)
    assert opened(SetSplines(160, 162))[Harmonic].drive.ratio == -80.0
