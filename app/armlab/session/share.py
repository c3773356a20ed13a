"""A state as a short text for links: everything on the table, and nothing about the student."""

from __future__ import annotations

import base64
import binascii
import json
import re
import zlib

import numpy as np

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.parts.display import OF_THE_SCREEN, Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.parts.target import FARTHEST, Target
from armlab.session.share_text import LONGEST, TEXT
from armlab.session.share_words import FREQUENT
from armlab.session.state import Json, Part, State

VERSION = "1"
"""First character of every text. Other versions have other words in `FREQUENT`, or read parts differently."""

MOST_BYTES = 64 << 10
"""Largest size of the unpacked state, bytes: a usual one has some 4 kB."""

STAYS = ("lesson", "shelf", "former", "welcome", "errata_practice", "own_lessons", "preview", "language")
"""Keys of the parts that are never shared: progress and answers, the student's name, states put aside, the welcome,
what was loaded, the language."""

DECIMALS = 9
"""Decimals of metres and radians outside the table: the screen does not show a thousandth of that."""

MOST_WORDS = 500
"""Longest name or line about an arm, in characters."""

MARKUP = re.compile(r"<[a-zA-Z/!?]|[\x00-\x08\x0b-\x1f\x7f]")
"""Pattern that no name of an arm or pose needs, but script injection would."""


def short(state: State) -> str:
    """Return the text of a state, at most `LONGEST` characters.

    Numbers outside a student's own table are rounded to `DECIMALS`.

    Raises
    ------
    InputError
        It does not fit into a link, or an own arm has a name that a link does not take.
    """
    part = state[RobotPart]
    _check_words(part.robot)
    opened = _written(State.initial(part.robot))
    written = _written(state)
    data = {key: value for key, each in written.items() if (value := _without(each, opened[key])) is not None}
    data[RobotPart.key] = written[RobotPart.key]
    plain = json.dumps(data, separators=(",", ":"), ensure_ascii=False).encode()
    packer = zlib.compressobj(9, zdict=FREQUENT)
    packed = packer.compress(plain) + packer.flush()
    text = VERSION + base64.urlsafe_b64encode(packed).decode().rstrip("=")
    if len(text) > LONGEST:
        raise InputError(f"link: {len(text)} characters are too many (at most {LONGEST}); save the table as a file")
    return text


def from_short(text: str) -> State:
    """Return the state of a text.

    Raises
    ------
    InputError
        It is not one of `short`, or not one of this version of the lab.
    """
    plain = _unpacked(text)
    try:
        return _read(json.loads(plain))
    except Exception as error:
        # Nobody can list what a forged text may raise, and it must not be more than a refusal.
        reason = str(error) if isinstance(error, InputError) else type(error).__name__
        raise InputError(f"link: what it holds does not fit this version of the lab ({reason[:200]})") from error


def state_of_parts(parts: Json) -> State:
    """Return the state of parts written by `State.to_json`; raises any error when they are not usable."""
    return State.from_json(parts, robot_from_json(parts[RobotPart.key]))


def personal(state: State) -> list[Part]:
    """Return the parts that are the student's own at every place: what stays in a link, and what no file holds."""
    return [part for part in state if part.key in STAYS or not part.saved]


def _written(state: State) -> dict[str, Json]:
    """Return the shared data, rounded; an edited table keeps all its digits, as it is shared as text."""
    parts = {key: part for key, part in state.to_json().items() if key not in STAYS}
    parts[Display.key] = {name: on for name, on in parts[Display.key].items() if name not in OF_THE_SCREEN}
    return {key: _rounded(part) for key, part in parts.items()}


def _rounded(data: Json) -> Json:
    if isinstance(data, float):
        value = round(data, DECIMALS)
        return int(value) if value == int(value) else value
    if isinstance(data, dict):
        return {key: _rounded(value) for key, value in data.items()}
    return [_rounded(value) for value in data] if isinstance(data, list | tuple) else data


def _without(data: Json, opened: Json) -> Json:
    """Return the differences from the initial data; None when there are none."""
    if data == opened:
        return None
    if not isinstance(data, dict):
        return data
    return {key: value for key, value in data.items() if key not in opened or opened[key] != value}


def _unpacked(text: str) -> bytes:
    if not TEXT.match(text):
        got = f"got {len(text)} characters"
        raise InputError(f"link: expected 2 to {LONGEST} letters, digits, - and _ after /state/, {got}")
    if text[0] != VERSION:
        raise InputError(f"link: it was made by another version of the lab (expected {VERSION}, got {text[0]})")
    packed = text[1:] + "=" * (-len(text[1:]) % 4)
    unpacker = zlib.decompressobj(zdict=FREQUENT)
    try:
        plain = unpacker.decompress(base64.urlsafe_b64decode(packed), MOST_BYTES + 1)
    except (binascii.Error, zlib.error):
        raise InputError("link: a letter of it is wrong; copy the whole link again") from None
    if len(plain) > MOST_BYTES:
        raise InputError(f"link: it unpacks to more than {MOST_BYTES >> 10} kB; no state of the lab does")
    if not unpacker.eof or unpacker.unused_data:
        raise InputError("link: its end is missing or does not belong to it; copy the whole link again")
    return plain


def _read(data: Json) -> State:
    robot = robot_from_json(data[RobotPart.key])
    _check_words(robot)
    opened = State.initial(robot).to_json()
    for key, part in data.items():
        if key in STAYS or key not in opened:
            raise InputError(f"a part {key[:40]!r} has no place in a link")
        if isinstance(part, dict) and key != RobotPart.key:
            data[key] = {**opened[key], **part}
    state = state_of_parts({**opened, **data})
    _check_target(state)
    # As after a command: a clip that is not on, or a time behind its end, is put right.
    return state.replace(*(part.after(state, state) for part in state))


def _check_words(robot: Robot) -> None:
    """Refuse names that are not meant as names."""
    words = {"name": robot.name, "summary": robot.summary, "source": robot.source}
    words |= {f"pose {i + 1}": name for i, name in enumerate(robot.poses)}
    for where, word in words.items():
        if len(word) > MOST_WORDS:
            raise InputError(f"{where} of the arm: expected at most {MOST_WORDS} characters, got {len(word)}")
        if MARKUP.search(word):
            raise InputError(f"{where} of the arm: expected plain words, got markup or control characters")


def _check_target(state: State) -> None:
    pose, arm = state[Target].pose, state[Joints].arm
    if pose is not None and not np.linalg.norm(pose[:3, 3] - arm.base[:3, 3]) <= FARTHEST * 2.0 * arm.length_scale:
        raise InputError(f"target: farther than {FARTHEST:g} times the reach of the arm")
