"""What was saved and shared before still opens, and is written down as it was."""

import json

import pytest

from armlab.content.robots import catalogue
from armlab.session.parts.robot import RobotPart
from armlab.session.share import from_short, short, state_of_parts
from armlab.session.state import State, part_types
from support.sources import TOP

GOLDEN = json.loads((TOP / "tests/data/golden.json").read_text(encoding="utf-8"))
"""Of parts of the state, several that a PUMA 560 has had; of whole states and of links, those of some day's lab."""

PUMA = catalogue()["puma560"]


def written(data):
    """Return data as a file holds them."""
    return json.dumps(data, ensure_ascii=False)


def test_there_are_golden_data_of_every_part_and_of_many_links():
    assert len(GOLDEN["links"]) >= 20
    assert set(GOLDEN["parts"]) == {kind.key for kind in part_types() if kind.saved}


@pytest.mark.parametrize("kind", [kind for kind in part_types() if kind.saved], ids=lambda kind: kind.key)
def test_a_part_is_read_and_written_as_it_was(kind):
    for data in GOLDEN["parts"][kind.key]["puma560"]:
        again = kind.from_json(json.loads(written(data)), PUMA).to_json()
        assert written(as_it_was(again, data, kind.initial(PUMA).to_json())) == written(data)


@pytest.mark.parametrize("name", GOLDEN["states"])
def test_a_state_is_read_and_written_as_it_was(name):
    data = GOLDEN["states"][name]
    state = state_of_parts(json.loads(written(data)))
    again, initial = state.to_json(), State.initial(state[RobotPart].robot).to_json()
    assert {key: written(as_it_was(again[key], part, initial[key])) for key, part in data.items()} == {
        key: written(part) for key, part in data.items()
    }


@pytest.mark.parametrize("name", GOLDEN["links"])
def test_a_link_opens_what_it_did(name):
    text, data = GOLDEN["links"][name]
    state = from_short(text)
    again = state.to_json()
    opened = State.initial(state[RobotPart].robot).to_json()
    for key, part in data.items():
        if isinstance(part, dict) and key != RobotPart.key:
            part = {**opened[key], **part}
        assert rounded(again[key]) == rounded(part), key
    assert from_short(short(state)).to_json() == again


def as_it_was(again, data, initial):
    """Return what is written of a part without the fields that it has had only since; these have their defaults."""
    if not (isinstance(again, dict) and isinstance(data, dict)):
        return again
    since = again.keys() - data.keys()
    assert {key: again[key] for key in since} == {key: initial[key] for key in since}
    return {key: value for key, value in again.items() if key not in since}


def test_a_field_that_a_part_has_had_only_since_has_its_default():
    assert as_it_was({"mass": 2.0, "tool": 0.0}, {"mass": 2.0}, {"mass": 1.0, "tool": 0.0}) == {"mass": 2.0}
    with pytest.raises(AssertionError):
        as_it_was({"mass": 2.0, "tool": 3.0}, {"mass": 2.0}, {"mass": 1.0, "tool": 0.0})


def rounded(data):
    """Return data with numbers as links hold them."""
    if isinstance(data, float):
        return round(data, 9)
    if isinstance(data, dict):
        return {key: rounded(value) for key, value in data.items()}
    return [rounded(value) for value in data] if isinstance(data, list | tuple) else data
