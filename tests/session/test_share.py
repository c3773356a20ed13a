"""A state as the text of a link: short, faithful, without the student, and safe to open."""

import base64
import json
import re
import zlib
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.pose.tool.state import PoseView
from armlab.benches.robot.normal.state import DragLine
from armlab.benches.robot.table.state import Point, SetPoint
from armlab.benches.robot.trainer.commands import CheckAxes, CheckTable, ChooseDirection, SetAnswer, StartTrainer
from armlab.benches.robot.trainer.state import Trainer
from armlab.content.robots import OWN, catalogue, own_robot, parse_robot
from armlab.content.write_robot import robot_toml
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.session import share
from armlab.session.edits import SetCell, SetEnd
from armlab.session.fields import Set
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import PlaceTarget, Target
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.share import VERSION, from_short, short
from armlab.session.share_text import LONGEST
from armlab.session.state import State, apply
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import OpenShared, Shelf
from support.arms import random_arm, random_q
from support.done import done

PUMA = catalogue()["puma560"]
EVERY = tuple(catalogue().robots.values())


def busy(robot, rng):
    """A state in which nothing is as it opens, with numbers of many digits."""
    state = State.initial(robot)
    arm = robot.arm
    moves = [MoveJoint(i, value) for i, value in enumerate(random_q(arm, rng).tolist())]
    state = done(state, *moves, LockJoint(0, True), SetPoint(tuple(rng.uniform(-0.1, 0.1, 3))))
    T = np.array(state[Joints].tool_pose)
    T[:3, 3] += 0.01 * arm.length_scale * rng.normal(size=3)
    near = arm.base[:3, 3] + 0.2 * arm.length_scale * rng.normal(size=(2, 3))
    lines = [DragLine(k, near[k], rng.normal(size=3), object()) for k in (0, 1)]
    names = ("skeleton", "frames", "names", "trace", "ellipsoid", "projections", "angles", "lengths")
    wanted = {"angle": "rad", "length": "m", "variable": "theta", "book": "craig"}
    labels = [Set(Notation, name, value) for name, value in wanted.items()]
    shown = [Show(name, True) for name in names]
    clip = [
        OpenClip("film"),
        Seek(float(rng.uniform(0.0, 5.0))),
        Set(PoseView, "axes", "xyz"),
        Set(PoseView, "fixed", True),
    ]
    return done(state, PlaceTarget(T), *lines, *shown, *labels, *clip)


def own_arm(seed, n=10):
    return own_robot(random_arm(np.random.default_rng(seed), n), "My arm")


def unpacked(text):
    return zlib.decompressobj(zdict=share.FREQUENT).decompress(base64.urlsafe_b64decode(text[1:] + "==="))


def packed(plain, version=VERSION):
    packer = zlib.compressobj(9, zdict=share.FREQUENT)
    return version + base64.urlsafe_b64encode(packer.compress(plain) + packer.flush()).decode().rstrip("=")


def forged(change, state=None):
    """The text of a state with something changed in its JSON."""
    data = json.loads(unpacked(short(state or busy(PUMA, np.random.default_rng(0)))))
    return packed(json.dumps(data | change).encode())


@pytest.mark.parametrize("robot", EVERY, ids=lambda robot: robot.key)
def test_every_arm_comes_back_as_it_was_left(robot):
    state = busy(robot, np.random.default_rng(robot.arm.n))
    text = short(state)
    assert len(text) <= 600
    again = from_short(text)
    assert again[RobotPart].robot is robot
    np.testing.assert_allclose(again[Joints].q, state[Joints].q, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(again[Target].pose, state[Target].pose, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(again[Point].xyz, state[Point].xyz, rtol=0.0, atol=1e-9)
    assert again[Joints].locked == state[Joints].locked
    assert again[Notation] == state[Notation]
    assert again[PoseView] == state[PoseView]
    assert dict(again[Display].switches) == dict(state[Display].switches)
    assert (again[Timeline].clip, again[Timeline].playing) == ("film", False)
    assert again[Timeline].time == pytest.approx(state[Timeline].time, abs=1e-9)


def test_the_longest_of_busy_own_arms_fits_a_link():
    states = [busy(own_arm(seed), np.random.default_rng(seed)) for seed in range(4)]
    lengths = [len(short(state)) for state in states]
    assert max(lengths) <= LONGEST
    for state in states:
        again = from_short(short(state))
        assert again[RobotPart].own
        for row, meant in zip(again[Joints].arm.rows, state[Joints].arm.rows, strict=True):
            assert row.kind == meant.kind
            assert (row.a, row.d) == (meant.a, meant.d)
            assert (row.alpha, row.theta) == pytest.approx((meant.alpha, meant.theta), abs=1e-14)
        np.testing.assert_allclose(again[Joints].q, state[Joints].q, rtol=0.0, atol=1e-9)


def test_a_whole_exercise_fits_a_link():
    rows = [("R", 0.1 + 0.0125 * i, (-1) ** i * np.pi / 2, 0.05 * i + 0.1, 0.0) for i in range(10)]
    robot = own_robot(Arm.from_dh(rows), "Ten joints")
    state = apply(State.initial(robot), StartTrainer())
    for i, directions in enumerate(state[Trainer].exercise.solution):
        state = done(state, *(ChooseDirection(i, axis, way) for axis, way in zip("zx", directions, strict=True)))
    state = apply(state, CheckAxes())
    for i, row in enumerate(state[Trainer].assignment.rows):
        state = done(state, *(SetAnswer(i, name, getattr(row, name)) for name in ("a", "alpha", "d", "theta")))
    state = apply(state, CheckTable())
    assert state[Trainer].done
    text = short(state)
    assert len(text) <= LONGEST
    assert from_short(text)[Trainer].answers.cells[3] == pytest.approx(state[Trainer].answers.cells[3], abs=1e-9)
    assert from_short(text)[Trainer].done


def test_what_is_as_it_opens_takes_no_room():
    assert len(short(State.initial(PUMA))) < 40
    assert from_short(short(State.initial(PUMA))).to_json() == State.initial(PUMA).to_json()


def test_a_text_is_the_same_for_the_same_state():
    state = busy(PUMA, np.random.default_rng(5))
    assert short(state) == short(state)
    assert re.fullmatch(r"[A-Za-z0-9_-]+", short(state))


def test_an_edited_table_travels_whole():
    state = done(State.initial(PUMA), SetCell(1, "a", 0.123456789012345), SetCell(2, "alpha", 1.0))
    again = from_short(short(state))
    assert again[RobotPart].own
    assert again[RobotPart].origin == "puma560"
    assert again[RobotPart].robot.arm.rows[1].a == 0.123456789012345


def test_a_target_at_a_small_arm_far_away_travels():
    base = np.eye(4)
    base[0, 3] = 90.0
    small = [SetCell(i, "a", 0.02) for i in (0, 1)]
    state = done(State.initial(catalogue()["planar_2r"]), *small, SetEnd("base", base))
    state = apply(state, PlaceTarget(state[Joints].tool_pose))
    np.testing.assert_allclose(from_short(short(state))[Target].pose, state[Target].pose, rtol=0.0, atol=1e-9)


def test_progress_name_and_shelf_stay():
    lesson = done(State.initial(PUMA), SignAs("Ada Lovelace"), OpenLesson("first_arm"), GoToStep(2), Answer("0.866"))
    state = apply(lesson, OpenShared(short(busy(PUMA, np.random.default_rng(1)))))
    for shared in (lesson, state):
        plain = unpacked(short(shared))
        assert not {"lesson", "shelf", "former", "welcome"} & set(json.loads(plain))
        assert b"Ada" not in plain
        assert b"first_arm" not in plain
        again = from_short(short(shared))
        assert again[LessonPart] == LessonPart.initial(PUMA)
        assert again[Shelf] == Shelf()


def test_everybody_keeps_their_own_theme():
    shared = short(done(State.initial(PUMA), Show("dark", True), Show("frames", True)))
    assert "dark" not in from_short(shared)[Display].switches
    at_night = done(State.initial(PUMA), Show("dark", True), Show("names", True), OpenShared(shared))
    assert dict(at_night[Display].switches) == {"frames": True, "dark": True}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "got 0 characters"),
        ("1", "got 1 characters"),
        ("1" + "A" * 1500, "got 1501 characters"),
        ("1<script>", "letters, digits"),
        ("1abc/..", "letters, digits"),
        ("1\n", "letters, digits"),
        ("2abcdef", "another version of the lab"),
        ("1AAAA", "copy the whole link"),
        ("1AAAAA", "copy the whole link"),
        (packed(b""), "does not fit"),
        (packed(b"{"), "does not fit"),
        (packed(b"[]"), "does not fit"),
        (packed(b"{}"), "does not fit"),
        (packed(b'{"robot":"gone"}'), "does not fit.*unknown name 'gone'"),
        (packed(b'{"robot":[]}'), "does not fit"),
        (packed(b'{"robot":{"toml":"","origin":""}}'), "does not fit"),
        (packed(b'{"robot":"puma560","lesson":{"open":"first_arm","progress":{}}}'), "has no place in a link"),
        (packed(b'{"robot":"puma560","shelf":{}}'), "has no place in a link"),
        (packed(b'{"robot":"puma560","unknown":1}'), "has no place in a link"),
        (packed(b"[" * 60_000), "does not fit"),
        (packed(b"9" * 5000), "does not fit"),
        (packed(b"\xff\xfe"), "does not fit"),
    ],
    ids=lambda value: repr(value[:30]),
)
def test_what_is_no_shared_state_is_refused_with_a_sentence(text, says):
    with pytest.raises(InputError, match=says):
        from_short(text)


@pytest.mark.parametrize("size", [65_537, 1 << 20])
def test_a_bomb_is_not_unpacked(size):
    text = packed(b'"' + b"a" * size + b'"')
    assert len(text) <= LONGEST
    with pytest.raises(InputError, match="more than 64 kB"):
        from_short(text)


def test_a_link_that_lost_its_end_says_so():
    text = short(busy(PUMA, np.random.default_rng(2)))
    for cut in range(2, len(text)):
        with pytest.raises(InputError, match="copy the whole link again"):
            from_short(text[:cut])


def test_a_link_with_something_behind_its_end_is_refused():
    text = short(busy(PUMA, np.random.default_rng(2)))
    packed = base64.urlsafe_b64decode(text[1:] + "===")
    assert from_short(VERSION + base64.urlsafe_b64encode(packed).decode().rstrip("=")).to_json()
    with pytest.raises(InputError, match="its end is missing or does not belong to it"):
        from_short(VERSION + base64.urlsafe_b64encode(packed + b"more").decode().rstrip("="))


@pytest.mark.parametrize(
    "change",
    [
        {"joints": {"q": [0.0]}},
        {"joints": {"q": [float("nan")] * 6}},
        {"joints": {"q": "all"}},
        {"joints": {"draws": -1}},
        {"joints": {"locked": [True]}},
        {"joints": 5},
        {"target": {"pose": [[1]]}},
        {"target": {"pose": [[1, 0, 0, 1e300], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}},
        {"target": {"method": "gone"}},
        {"point": [1e9, 0, 0]},
        {"timeline": {"time": float("inf")}},
        {"timeline": {"speed": 100}},
        {"pose_view": {"frame": "99"}},
        {"sweep": {"joint": 7}},
        {"lines": {"pair": 6}},
        {"trainer": {"shown": 1}},
        {"display": 1},
    ],
)
def test_values_that_cannot_be_are_refused(change):
    with pytest.raises(InputError, match=r"^link: what it holds does not fit"):
        from_short(forged(change))


@pytest.mark.parametrize("place", ["name", "summary", "source", "pose"])
@pytest.mark.parametrize("word", ["<script>alert(1)</script>", "</div>", "a\x00b", "<img src=x onerror=alert(1)>"])
def test_script_in_names_is_refused_by_both_sides(place, word):
    robot = own_arm(0, 3)
    evil = replace(robot, **({"poses": {word: robot.home}} if place == "pose" else {place: word}))
    with pytest.raises(InputError, match="expected plain words"):
        short(State.initial(evil))
    toml = robot_toml(evil)
    assert parse_robot(OWN, toml, proven=False).arm.n == 3
    with pytest.raises(InputError, match="expected plain words"):
        from_short(forged({"robot": {"toml": toml, "origin": ""}}, State.initial(robot)))


def test_a_name_without_end_is_refused():
    endless = replace(own_arm(0, 2), name="x" * 501)
    with pytest.raises(InputError, match="at most 500 characters"):
        short(State.initial(endless))


def test_what_does_not_fit_a_link_is_said(monkeypatch):
    monkeypatch.setattr(share, "LONGEST", 300)
    with pytest.raises(InputError, match="characters are too many"):
        short(busy(own_arm(1), np.random.default_rng(1)))


def test_mutations_of_texts_are_states_or_refusals():
    rng = np.random.default_rng(500)
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
    whole = [short(busy(robot, rng)) for robot in (PUMA, own_arm(3), catalogue()["scara"])]
    refused = 0
    for k in range(250):
        text = list(whole[k % 3])
        for _ in range(rng.integers(1, 4)):
            i = int(rng.integers(len(text)))
            action = rng.integers(3)
            if action == 0:
                text[i] = letters[rng.integers(64)]
            elif action == 1:
                del text[i]
            else:
                text.insert(i, letters[rng.integers(64)])
        refused += not opens("".join(text))
    assert refused > 225  # the checksum sees nearly all


def test_mutations_of_what_is_packed_are_states_or_refusals():
    rng = np.random.default_rng(501)
    plain = [unpacked(short(busy(robot, rng))) for robot in (PUMA, own_arm(4), catalogue()["scara"])]
    pieces = [b"-1", b"1e309", b"null", b"[]", b"{}", b'""', b"true", b"NaN", b"9" * 400, b'"\\ud800"', b"<b>"]
    outcomes = set()
    for k in range(90):
        data = bytearray(plain[k % 3])
        for _ in range(rng.integers(1, 4)):
            i = int(rng.integers(len(data)))
            j = i + int(rng.integers(0, 6))
            data[i:j] = pieces[rng.integers(len(pieces))] if rng.random() < 0.5 else bytes([rng.integers(256)])
        # Also whole values, so that what is inside gets read.
        if k % 2:
            values = list(re.finditer(rb"(?<=[:\[,])-?[0-9.]+(?=[,\]}])", plain[k % 3]))
            value = values[rng.integers(len(values))]
            data = bytearray(plain[k % 3])
            data[value.start() : value.end()] = pieces[rng.integers(len(pieces))]
        outcomes.add(opens(packed(bytes(data))))
    assert outcomes == {True, False}


def opens(text):
    """Return whether a text is a state, which then can be written down again; anything but a refusal fails the test."""
    if len(text) > LONGEST:
        return False
    try:
        state = from_short(text)
    except InputError as refusal:
        said = str(refusal)
    else:
        json.dumps(state.to_json(), allow_nan=False)
        return True
    assert said.startswith("link: ")
    assert len(said) < 400
    return False
