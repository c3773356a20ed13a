"""What a teacher reads when a robot file is wrong: file, key, what was expected, what is available."""

import pytest

from armlab.content.robots import parse_robot, read_catalogue
from armlab.errors import ContentError, UnknownName

GOOD = """
name = "Two links"
family = "planar"
summary = "A test."
convention = "standard"
source = "Made up for a test."

[[joints]]
type = "R"
a = 1.0
limits_deg = [-180, 180]
speed_deg_s = 90

[[joints]]
type = "P"
d = 0.1
theta_deg = 90
limits_m = [0.0, 0.5]

[[poses]]
name = "home"
q_deg_m = [10, 0.2]

[[expected]]
q_deg_m = [0, 0]
position = [1.0, 0.0, 0.1]
source = "by hand"

[[expected]]
q_deg_m = [90, 0.2]
position = [0.0, 1.0, 0.3]
source = "by hand"
"""


def changed(*pairs):
    text = GOOD
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def viewed_from(distance):
    """What has to be replaced, and by what, so that the file has a camera."""
    before = 'source = "Made'
    return before, f"camera = {{ azimuth_deg = 0, elevation_deg = 20, distance = {distance} }}\n{before}"


def test_a_good_file_is_read():
    robot = parse_robot("two", GOOD)
    assert robot.arm.n == 2
    assert robot.arm.limits[0, 1] == pytest.approx(3.14159265, abs=1e-8)
    assert robot.arm.speed_limits.tolist() == pytest.approx([1.5707963, float("inf")])
    assert robot.home.tolist() == pytest.approx([0.17453293, 0.2])


def test_a_byte_order_mark_is_no_part_of_a_file():
    assert parse_robot("two", "\ufeff" + GOOD).name == parse_robot("two", GOOD).name


@pytest.mark.parametrize(
    ("pairs", "text"),
    [
        ([("a = 1.0", "aa = 1.0")], r"two\.toml: joints\[1\]\.aa: unknown key; did you mean 'a'\? Available: a, "),
        ([("theta_deg", "theta")], r"joints\[2\]\.theta: the unit belongs into the name: write theta_deg"),
        ([("limits_deg", "limits")], r"joints\[1\]\.limits: the unit belongs into the name: write limits_deg"),
        ([("limits_m", "limits_deg")], r"joints\[2\]\.limits_m: missing; the file has type, d, theta_deg, limits_deg"),
        ([("[-180, 180]", "[180, -180]")], r"joints\[1\]\.limits_deg: the smaller comes first, got \[180, -180\]"),
        ([("a = 1.0", "a = nan")], r"joints\[1\]\.a: expected a finite number, got nan"),
        ([("a = 1.0", f"a = {'9' * 400}")], r"joints\[1\]\.a: expected a number below 1\.8e308, got 9+\.\.\.$"),
        ([("a = 1.0", f"a = 0x{'f' * 5000}")], r"joints\[1\]\.a: expected .*, got int too long to be shown$"),
        ([("a = 1.0", f"a = {'9' * 5000}")], r"two\.toml: a number has too many digits"),
        ([("a = 1.0", f"a = {'[' * 5000}")], r"two\.toml: brackets are nested too deep"),
        ([("a = 1.0", "a = inf")], r"expected a finite number, got inf"),
        ([('name = "home"', 'name = "random"')], r"poses\[1\]\.name: 'random' is taken"),
        (
            [("[[expected]]", '[[poses]]\nname = "home"\nq_deg_m = [0, 0]\n\n[[expected]]')],
            r"poses\[2\]\.name: 'home' is taken; choose a name that is not home, random$",
        ),
        (
            [("position = [1.0, 0.0, 0.1]", "position = [1.0, 0.0, 0.1]\ntolerance = 1e9")],
            r"expected\[1\]\.tolerance: expected a positive number up to 0\.001, got 1e\+09",
        ),
        (
            [("position = [1.0, 0.0, 0.1]", "position = [1.0, 0.0, 0.1]\ntolerance = 0")],
            r"expected\[1\]\.tolerance: expected a positive number up to 0\.001, got 0",
        ),
        ([("a = 1.0", 'a = "1.0"')], r"joints\[1\]\.a: expected a number, got '1.0'"),
        ([("a = 1.0", "a = true")], r"joints\[1\]\.a: expected a number, got True"),
        ([("[0.0, 0.5]", "[0.0]")], r"joints\[2\]\.limits_m: expected 2 numbers in brackets, got \[0\.0\]"),
        ([('type = "P"', 'type = "S"')], r"joints\[2\]\.type: unknown value 'S'.*Available: P, R"),
        ([("speed_deg_s = 90", "speed_deg_s = 0")], r"joints\[1\]\.speed_deg_s: expected a positive number, got 0"),
        ([('"planar"', '"flat"')], r"family: unknown value 'flat'"),
        ([('"standard"', '"craig"')], r"convention: unknown value 'craig'.*Available: modified, standard"),
        ([('source = "Made', 'task = "pos"\nsource = "Made')], r"task: unknown value 'pos'; did you mean 'pose'"),
        ([viewed_from("0")], r"camera\.distance: expected a positive number up to 100, got 0"),
        ([viewed_from("-1")], r"camera\.distance: expected a positive number up to 100, got -1"),
        ([viewed_from("1e308")], r"camera\.distance: expected a positive number up to 100, got 1e\+308"),
        ([('name = "Two links"', "")], r"name: missing; the file has family, summary,"),
        ([('name = "Two links"', 'name = ""')], r"name: expected a text, got ''"),
        ([('name = "Two links"', 'name = "Two links')], r"two\.toml: not valid TOML: .*line 2"),
        (
            [("q_deg_m = [10, 0.2]", "q_deg_m = [10, 0.7]")],
            r"poses\[1\]\.q: the pose 'home' is outside the joint limits",
        ),
        ([("q_deg_m = [10, 0.2]", "q_deg = [10, 0.2]")], r"poses\[1\]\.q_deg_m: missing; the file has name, q_deg"),
        (
            [("[[joints]]\ntype", "[[joint]]\ntype"), ("[[joints]]\ntype", "[[joint]]\ntype")],
            r"joints: expected 1 to 12",
        ),
        ([("[[expected]]\nq_deg_m = [0, 0]", "[extra]\nq_deg_m = [0, 0]")], r"expected: give at least two poses"),
        ([("position = [1.0, 0.0, 0.1]", "position = 3")], r"expected\[1\]\.position: expected 3 numbers"),
        ([('[[joints]]\ntype = "R"', 'joints = 3\n[x]\ntype = "R"')], "not valid TOML"),
    ],
)
def test_what_is_wrong_is_named(pairs, text):
    with pytest.raises(ContentError, match=text):
        parse_robot("two", changed(*pairs))


@pytest.mark.parametrize("key", ["WallArm", "wall arm", "wall.arm", "_wall", "wände", "w" * 65, ""])
def test_a_file_name_that_cannot_stand_in_a_link_is_refused(key):
    with pytest.raises(ContentError, match=r"expected a file name of lower-case letters, digits and underscores, got "):
        parse_robot(key, GOOD)


def test_a_file_may_have_a_zero_of_its_own():
    robot = parse_robot("two", changed(('name = "home"', 'name = "zero"')))
    assert robot.poses["zero"].tolist() == pytest.approx([0.17453293, 0.2])


def test_forty_joints_are_refused():
    joint = '[[joints]]\ntype = "R"\nlimits_deg = [-1, 1]\n\n'
    with pytest.raises(ContentError, match=r"joints: expected 1 to 12 tables \[\[joints\]\], got 42"):
        parse_robot("two", changed(("[[poses]]", joint * 40 + "[[poses]]")))


def test_a_left_over_table_is_an_unknown_key():
    with pytest.raises(ContentError, match=r"extra: unknown key"):
        parse_robot("two", GOOD + "\n[extra]\nx = 1\n")


def test_a_broken_file_disturbs_no_other(tmp_path):
    (tmp_path / "good.toml").write_text(GOOD, encoding="utf-8")
    (tmp_path / "bad.toml").write_text(GOOD.replace("a = 1.0", "a = nan"), encoding="utf-8")
    (tmp_path / "worse.toml").write_bytes(b"name = \xff")
    found = read_catalogue(sorted(tmp_path.iterdir()))
    assert list(found.robots) == ["good"]
    assert [problem.file for problem in found.problems] == ["bad.toml", "worse.toml"]
    with pytest.raises(ContentError, match="finite"):
        found["bad"]
    with pytest.raises(UnknownName, match="did you mean 'good'"):
        found["god"]


class Unreadable:
    """A file that raises when it is read."""

    def __init__(self, error):
        self.name, self._error = "bad.toml", error

    def read_text(self, encoding):
        raise self._error


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (PermissionError(13, "Permission denied"), r"^bad\.toml: cannot be read: Permission denied$"),
        (RuntimeError("a mistake of ours"), r"^bad\.toml: cannot be used: RuntimeError\('a mistake of ours'\)$"),
    ],
)
def test_a_file_that_cannot_be_read_disturbs_no_other(tmp_path, error, text):
    good = tmp_path / "good.toml"
    good.write_text(GOOD, encoding="utf-8")
    found = read_catalogue([Unreadable(error), good])
    assert list(found.robots) == ["good"]
    with pytest.raises(ContentError, match=text):
        found["bad"]
