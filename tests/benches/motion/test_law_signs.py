"""Timing laws: an acceleration of signs on intervals, as printed and corrected, typed, drawn and made a law."""

import pytest

from armlab.benches.motion.laws.examples import ChooseLawExample
from armlab.benches.motion.laws.facts import FACTS
from armlab.benches.motion.laws.sign_commands import ReadSigns, SetSigns, UseSigns
from armlab.benches.motion.laws.signs import MOST, Signs, read, written
from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.ui.signs import bands, signs_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion.signs import ON_8, ON_8_PRINTED
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.done import done
from support.forms import BareForm, asked


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def fact(name, state):
    return FACTS.facts[name].now(state).value


def test_the_printed_intervals_say_no_acceleration_and_the_corrected_ones_end_at_rest(truth):
    printed, corrected = opened(ReadSigns("eighths")), opened(ReadSigns("whole"))
    assert fact("undetermined", printed) == truth["ERR-1.41"]["printed_value_if_wrong"]["printed_residual"]
    assert fact("signs_end", printed) is None
    assert fact("undetermined", corrected) == 0.0
    assert fact("signs_end", corrected) == (0.0, 0.0)


def test_the_intervals_become_a_law_that_ends_as_they_say():
    state = opened(SetSigns("plus", "0-3"), SetSigns("minus", "3-8"), UseSigns())
    (law,) = state[Laws].laws
    assert fact("signs_end", state) == (law.at(8.0, 1), law.at(8.0)) == (-2.0, 7.0)
    with pytest.raises(InputError, match=r"at 39\.06 % of the time both signs hold or none"):
        UseSigns().apply(opened(ReadSigns("eighths")))


def test_an_example_of_laws_leaves_the_intervals_alone():
    state = opened(SetSigns("plus", "0-2"), ChooseLawExample("triangle"))
    assert state[Laws].signs.plus == ((0.0, 2.0),)
    assert apply(state, ReadSigns("whole"))[Laws].example == "triangle"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0-1, 3/8-4", ((0.0, 1.0), (0.375, 4.0))),
        ("[0, 1]", None),
        ("0 1; 2–3", ((0.0, 1.0), (2.0, 3.0))),
        ("", ()),
        ("0-1-2", None),
        ("a-b", None),
        ("1", None),
    ],
)
def test_typed_intervals_are_read_or_refused_with_what_was_expected(text, expected):
    if expected is None:
        with pytest.raises(InputError, match=r"s̈ = \+1 on: expected intervals such as 0-1"):
            read(text, "s̈ = +1 on")
    else:
        assert read(text, "") == expected


@pytest.mark.parametrize("some", [*ON_8, *ON_8_PRINTED, ((0.1, 2.5),), ((1 / 9, 8 / 3),), ((0.1234567, 2.6667),)])
def test_what_is_written_is_read_back(some):
    assert read(written(some), "") == some


def test_nonsense_is_refused_and_the_state_stays():
    with pytest.raises(InputError, match="both"):
        SetSigns("both", "0-1").apply(opened())
    with pytest.raises(InputError, match="thirds"):
        ReadSigns("thirds").apply(opened())
    with pytest.raises(InputError, match=f"at most {MOST}"):
        read(", ".join(f"{k}-{k + 1}" for k in range(MOST + 1)), "")
    for junk in ({"plus": [[0]], "minus": [], "duration": 8}, {"plus": [], "minus": [], "duration": 0}, {"plus": 3}):
        with pytest.raises(InputError):
            Laws.from_json({"signs": junk}, catalogue()["puma560"])


def test_the_bands_mark_what_is_undetermined():
    assert str(bands(Signs())).count("law-doubt") == 0
    printed = str(bands(Signs(*ON_8_PRINTED)))
    assert printed.count("law-doubt") == 1
    assert "undetermined for 39.06 %" in printed


@pytest.mark.parametrize(("minus", "share"), [("1-3, 4-5, 7-7.9999", "0.00125 %"), ("1-3, 4-5", "12.5 %")])
def test_however_little_is_undetermined_its_share_is_not_zero(minus, share):
    state = opened(ReadSigns("whole"), SetSigns("minus", minus))
    assert f"Undetermined for {share}<" in str(joined(signs_markup(BareForm(), state[Laws])))
    with pytest.raises(InputError, match=f"at {share} of the time"):
        UseSigns().apply(state)


def test_fields_and_buttons_become_commands():
    part = opened()[Laws]

    def typed(cell, text=""):
        return asked(lambda form: joined(signs_markup(form, part)), cell, text)

    assert typed("signs plus", "0-2") == (SetSigns("plus", "0-2"),)
    assert typed("reading eighths") == (ReadSigns("eighths"),)
    assert typed("use-signs") == (UseSigns(),)
    with pytest.raises(InputError, match="−1 on: expected intervals"):
        typed("signs minus", "soon")
