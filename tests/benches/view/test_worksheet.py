"""Worksheets: the numbers on paper are those of kin, and names are never markup."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.view.share.worksheet import FORMATS, task_jacobian, worksheet
from armlab.benches.view.share.worksheet_formats import LONGEST_NAME, latex_text, markdown_text
from armlab.content.markdown import to_html
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import velocity_ellipsoid
from armlab.kin.length_power import length_power
from armlab.kin.rotations import rotation_from_axis_angle, rotation_from_sequence
from armlab.kin.symbolic import constants
from support.arms import frames_by_products, jacobian_by_differences, random_arm, random_q

HALF = 0.5e-4 * (1 + 1e-9)
"""Largest error of four decimals."""

ROBOTS = catalogue().robots
NUMBER = r"[−-]?\d+\.\d{4}"
HOSTILE = (
    "a|b",
    "# *x* _y_ `z`",
    "<script>alert(1)</script>",
    "[a](javascript:alert(1))",
    "![a](http://example.org/x.png)",
    "a\n\n# b\r\n| c |",
    "$x^2$ and $$y$$",
    r"\input{/etc/passwd} \write18{ls} \\ \end{document}",
    '50% of #1 & co_2 ^~ {a} "b"',
    "```\ncode",
    "Čapek ą Å ½ 中文 😀 Ω\u202e\u200b\x00",
)


def values(text):
    return [float(found.replace("−", "-")) for found in re.findall(NUMBER, text)]


def matrices(text, format):
    """Return the matrices of a worksheet by what stands before their equals sign, indices as plain letters."""
    if format == "markdown":
        found = re.findall(r"^(\S+) =\n\n```text\n(.*?)\n```$", text, re.MULTILINE | re.DOTALL)
        return {
            name.translate(str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")): rows(body.split("\n")) for name, body in found
        }
    found = re.findall(r"^(\S+) =\n\\begin\{bmatrix\}\n(.*?)\n\\end\{bmatrix\}$", text, re.MULTILINE | re.DOTALL)
    return {re.sub(r"\\mathrm|[{}]", "", name).replace("A_", "A"): rows(body.split("\\\\\n")) for name, body in found}


def rows(lines):
    return np.array([values(line) for line in lines])


def cells(text, format, first):
    """Return the rows of the table whose head begins with a word."""
    if format == "markdown":
        table = next(block for block in text.rstrip().split("\n\n") if block.startswith(f"| {first} |"))
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.split("\n")[2:]]
    table = next(block for block in text.split("\\toprule\n")[1:] if block.startswith(f"{first} &"))
    body = table.partition("\\midrule\n")[2].partition("\n\\bottomrule")[0]
    return [[cell.strip() for cell in line.removesuffix(r" \\").split(" & ")] for line in body.split("\n")]


def check(arm, q, text, format):
    """Assert that every number of a worksheet is right, by other ways than those it was written by."""
    found = matrices(text, format)
    frames = frames_by_products(arm, q)
    for i in range(arm.n):
        A = np.linalg.inv(frames[i]) @ frames[i + 1]
        np.testing.assert_allclose(found[f"A{i + 1}"], A, rtol=0, atol=HALF + 1e-9)
    T = frames[-1] @ arm.tool
    np.testing.assert_allclose(found["T"], T, rtol=0, atol=HALF + 1e-9)
    np.testing.assert_allclose(found["J"], jacobian_by_differences(arm, q), rtol=0, atol=HALF + 1e-7)
    np.testing.assert_allclose(found["J_task"], task_jacobian(arm, q), rtol=0, atol=HALF)
    assert ("T_base" in found) == (not np.array_equal(arm.base, np.eye(4)))
    assert ("T_tool" in found) == (not np.array_equal(arm.tool, np.eye(4)))
    product = found.get("T_base", np.eye(4))
    for i in range(arm.n):
        product = product @ found[f"A{i + 1}"]
    np.testing.assert_allclose(product @ found.get("T_tool", np.eye(4)), T, rtol=0, atol=2e-3)
    (position,) = re.findall(r"^Position .*", text, re.MULTILINE)
    np.testing.assert_allclose(values(position), T[:3, 3], rtol=0, atol=HALF + 1e-9)


def check_orientation(R, text, unit):
    (angles,) = re.findall(r"^Orientation: .*", text, re.MULTILINE)
    turn = np.array(values(angles)[:3]) * unit
    R_said = rotation_from_sequence("zyx", turn)
    np.testing.assert_allclose(R_said, R, rtol=0, atol=2e-4)
    (one,) = re.findall(r"^The same as one turn: .*", text, re.MULTILINE)
    angle, *axis = values(one)
    about = np.array(axis) / np.linalg.norm(axis) if axis else np.array([0.0, 0.0, 1.0])
    np.testing.assert_allclose(rotation_from_axis_angle(about, angle * unit), R, rtol=0, atol=5e-4)


@pytest.mark.parametrize("key", ROBOTS)
@pytest.mark.parametrize("format", FORMATS)
def test_every_robot_has_a_worksheet_with_the_numbers_of_kin(key, format):
    robot = ROBOTS[key]
    for q in (robot.home, random_q(robot.arm, np.random.default_rng(3))):
        text = worksheet(robot, q, format)
        check(robot.arm, q, text, format)
        check_orientation(robot.arm.fk(q)[:3, :3], text, math.pi / 180)


@pytest.mark.parametrize("format", FORMATS)
def test_any_arm_has_a_worksheet(format):
    rng = np.random.default_rng(4)
    for n, convention, special in itertools.product((1, 2, 6, 12), ("standard", "modified"), (False, True)):
        arm = random_arm(rng, n, convention=convention, special=special)
        q = random_q(arm, rng)
        text = worksheet(own_robot(arm, "x"), q, format, angle="rad")
        check(arm, q, text, format)
        check_orientation(arm.fk(q)[:3, :3], text, 1.0)


@pytest.mark.parametrize("key", ["planar_3r", "elbow_3r", "scara", "cylindrical_rpp"])
def test_symbols_of_a_short_arm_have_its_values(key):
    arm = ROBOTS[key].arm
    q = random_q(arm, np.random.default_rng(6))
    names = {**constants(arm), **{f"q{i}": value for i, value in enumerate(q, 1)}, "sin": math.sin, "cos": math.cos}
    turn = np.kron(np.eye(2), arm.base[:3, :3].T)
    expected = {"T": np.linalg.inv(arm.base) @ arm.fk(q), "J": turn @ arm.jacobian(q)}
    text = worksheet(ROBOTS[key], q)
    for symbol, values_now in expected.items():
        (block,) = re.findall(rf"^{symbol} in symbols:\n\n```text\n(.*?)\n```$", text, re.MULTILINE | re.DOTALL)
        entries = [re.split("  +", line) for line in block.split("\n")]
        found = [[eval(entry.replace("−", "-"), dict(names)) for entry in row] for row in entries]
        np.testing.assert_allclose(found, values_now, rtol=0, atol=1e-12)
    assert r"J = \begin{bmatrix}" in worksheet(ROBOTS[key], q, "latex")


@pytest.mark.parametrize("format", FORMATS)
def test_symbols_that_are_too_long_are_said_to_be(format):
    text = worksheet(ROBOTS["puma560"], ROBOTS["puma560"].home, format).replace("$", "")
    general = random_arm(np.random.default_rng(7), 6)
    said = worksheet(own_robot(general, "x"), np.zeros(6), format).replace("$", "")
    assert "T in symbols is too long to read here." in said
    assert "J in symbols is too long to read here." in text
    assert ("cos θᵢ" if format == "markdown" else r"\cos\theta_i") in text


# --- The table


@pytest.mark.parametrize(
    ("convention", "order"), [("standard", ("a", "alpha", "d", "theta")), ("modified", ("alpha", "a", "d", "theta"))]
)
@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("angle", ["deg", "rad"])
def test_the_table_reads_back_in_the_order_of_its_convention(convention, order, format, angle):
    rng = np.random.default_rng(5)
    factor = math.pi / 180 if angle == "deg" else 1.0
    for _ in range(5):
        arm = random_arm(rng, 5, convention=convention)
        text = worksheet(own_robot(arm, "x"), random_q(arm, rng), format, angle=angle)
        for i, (row, (joint, *entries)) in enumerate(zip(arm.rows, cells(text, format, "joint"), strict=True)):
            assert joint == f"{i + 1} {row.kind}"
            for name, entry in zip(order, entries, strict=True):
                unit = factor if name in ("alpha", "theta") else 1.0
                signs = re.sub(r"([−-]) (?=\d)", r"\1", entry.replace("+ ", ""))
                (value,) = values(signs)
                assert value * unit == pytest.approx(getattr(row, name), abs=HALF)
                assert ("q" in entry) == (name == ("theta" if row.revolute else "d"))


def test_heads_have_the_symbols_and_units_of_the_convention():
    arm = [("R", 1.0, 0.0, 0.0, 0.0)]
    standard, modified = (own_robot(Arm.from_dh(arm, name), "x") for name in ("standard", "modified"))
    assert "| joint | aᵢ [m] | αᵢ [°] | dᵢ [m] | θᵢ [°] |" in worksheet(standard, [0.0])
    assert "| joint | αᵢ₋₁ [rad] | aᵢ₋₁ [m] | dᵢ [m] | θᵢ [rad] |" in worksheet(modified, [0.0], angle="rad")
    assert "Aᵢ = Rx(αᵢ₋₁) Tx(aᵢ₋₁) Rz(θᵢ) Tz(dᵢ)." in worksheet(modified, [0.0])
    head = r"joint & $\alpha_{i-1}$ [$^\circ$] & $a_{i-1}$ [m] & $d_{i}$ [m] & $\theta_{i}$ [$^\circ$] \\"
    assert head in worksheet(modified, [0.0], "latex")


def test_joint_values_have_their_units():
    arm = Arm.from_dh([("R", 0.0, 0.0, 0.5, 0.0), ("P", 0.0, 0.0, 0.25, 0.0)])
    robot = own_robot(arm, "x")
    text = worksheet(robot, [-math.pi / 6, 0.75])
    assert "| 1 R | q₁ | −30.0000° |" in text
    assert "| 2 P | q₂ | 0.7500 m |" in text
    assert "| 2 P | 0.0000 | 0.0000 | q₂ + 0.2500 | 0.0000 |" in text
    assert "| 1 R | q₁ | −0.5236 rad |" in worksheet(robot, [-math.pi / 6, 0.75], angle="rad")
    latex = worksheet(robot, [-math.pi / 6, 0.75], "latex")
    assert r"1 R & $q_{1}$ & $-30.0000^\circ$ \\" in latex
    assert r"2 P & $q_{2}$ & $0.7500$ m \\" in latex


def test_a_planar_2r_by_hand():
    """l1 = l2 = 1 m at (0, 90) degrees: p = (1, 1), J = [[-1, -1], [1, 0]], w = sin 90 = 1."""
    text = worksheet(ROBOTS["planar_2r"], [0.0, math.pi / 2])
    assert "Position p = (1.0000, 1.0000, 0.0000) m." in text
    np.testing.assert_array_equal(matrices(text, "markdown")["J_task"], [[-1.0, -1.0], [1.0, 0.0]])
    golden = (math.sqrt(5) + 1) / 2
    measures = cells(text, "markdown", "measure")
    assert [row[0] for row in measures] == [
        "manipulability w of the task",
        "σ_min of linear velocity",
        "condition of linear velocity",
    ]
    assert [row[1:] for row in measures] == [
        ["1.0000", "m²"],
        [f"{1 / golden:.4f}", "m/s per rad/s"],
        [f"{golden**2:.4f}", ""],
    ]


def test_a_singular_arm_says_so():
    for format, sign in (("markdown", "∞"), ("latex", r"$\infty$")):
        text = worksheet(ROBOTS["planar_2r"], [0.3, 0.0], format)
        assert cells(text, format, "measure")[-1][1:] == [sign, "singular"]


# --- Measures


@pytest.mark.parametrize("key", ROBOTS)
def test_measures_are_those_of_kin_and_never_mix_units(key):
    arm, q = ROBOTS[key].arm, ROBOTS[key].home
    found = {row[0]: row[1:] for row in cells(worksheet(ROBOTS[key], q), "markdown", "measure")}
    (w,) = values(found["manipulability w of the task"][0])
    assert w == pytest.approx(float(arm.manipulability(q)), abs=HALF)
    J, p = task_jacobian(arm, q), len(arm.task.position)
    mixed = not arm.revolute.all() and bool(arm.revolute.any())
    scale = np.where(np.isfinite(arm.speed_limits), arm.speed_limits, 1.0) if mixed else None
    for name, block, unit in (("linear", J[:p], "m/s"), ("angular", J[p:], "rad/s")):
        assert (f"σ_min of {name} velocity" in found) == (len(block) > 0)
        if len(block):
            shape = velocity_ellipsoid(block, scale)
            (sigma,) = values(found[f"σ_min of {name} velocity"][0])
            assert sigma == pytest.approx(shape.sigma_min, abs=HALF)
            assert found[f"σ_min of {name} velocity"][1].startswith(unit)
            assert ("per" in found[f"σ_min of {name} velocity"][1]) == (not mixed)


def test_the_volume_of_the_task_jacobian_is_the_manipulability():
    rng = np.random.default_rng(6)
    for robot in ROBOTS.values():
        for q in random_q(robot.arm, rng, 3):
            J = task_jacobian(robot.arm, q)
            wide = J if J.shape[0] <= J.shape[1] else J.T
            expected = math.sqrt(max(0.0, np.linalg.det(wide @ wide.T)))
            # Products of rounded entries: the root loses half of the digits at singularities.
            assert float(robot.arm.manipulability(q)) == pytest.approx(expected, rel=1e-6, abs=1e-7)


@pytest.mark.parametrize(
    ("kinds", "task"),
    [
        ("RR", "xy"),
        ("RRR", "xy phi"),
        ("RRR", "xy"),
        ("RRP", "xyz"),
        ("PPP", "xyz"),
        ("RRRR", "xyz phi"),
        ("RRRRRR", "pose"),
        ("RPRRRR", "pose"),
        ("RR", "xyz"),
        ("RP", "xyz"),
        ("RRRP", "xyz"),
        ("RR", "pose"),
        ("RRRRR", "xyz approach"),
    ],
)
def test_the_unit_of_w_is_how_it_changes_with_the_unit_of_length(kinds, task):
    """In another unit of length w is multiplied by a power of the ratio, or by nothing constant where units mix."""
    rng = np.random.default_rng(7)
    ratio, factors = 10.0, []
    for _ in range(4):
        rows = [(kind, *rng.uniform(-1.0, 1.0, 4).tolist()) for kind in kinds]
        longer = [(kind, ratio * a, alpha, ratio * d, theta) for kind, a, alpha, d, theta in rows]
        q = rng.uniform(0.2, 0.9, len(kinds))
        small, large = Arm.from_dh(rows, task=task), Arm.from_dh(longer, task=task)
        lengths = np.where(small.revolute, 1.0, ratio)
        w, w_longer = float(small.manipulability(q)), float(large.manipulability(q * lengths))
        factors.append(math.log10(w_longer / w))
    unit = length_power(Arm.from_dh(rows, task=task))
    if unit is None:
        assert np.ptp(factors) > 1e-3
    else:
        np.testing.assert_allclose(factors, unit, rtol=0, atol=1e-6)


# --- Names from people


@pytest.mark.parametrize("name", HOSTILE)
def test_no_name_is_markup_in_markdown(name):
    robot = replace(ROBOTS["planar_2r"], name=name)
    text, plain = worksheet(robot, robot.home), worksheet(ROBOTS["planar_2r"], robot.home)
    assert text.splitlines()[1:] == plain.splitlines()[1:]
    head, _, rest = to_html(text, "x.md").partition("</h1>")
    assert rest == to_html(plain, "x.md").partition("</h1>")[2]
    assert re.findall(r"<(?!h1>)", head) == []
    shown = head.removeprefix("<h1>Worksheet: ")
    for given, written in (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&amp;", "&")):
        shown = shown.replace(given, written)
    seen = "".join(letter for letter in name if letter not in "\u202e\u200b\x00").split()
    assert shown.split() == seen


@pytest.mark.parametrize("name", HOSTILE)
def test_no_name_is_a_command_in_latex(name):
    robot = replace(ROBOTS["planar_2r"], name=name)
    text, plain = worksheet(robot, robot.home, "latex"), worksheet(ROBOTS["planar_2r"], robot.home, "latex")
    changed = [(a, b) for a, b in zip(text.splitlines(), plain.splitlines(), strict=True) if a != b]
    assert [b for _, b in changed] == [r"\section*{Worksheet: Planar 2R}"]
    written = changed[0][0].removeprefix(r"\section*{Worksheet: ").removesuffix("}")
    assert written.isascii()
    own = r"\\(?:textbackslash|textasciitilde|textasciicircum)\{\}|\\[#$%&_{}]|\\[`'^~=u.\"rHvc]\{[A-Za-z]\}|\$[<>|]\$"
    left = re.sub(own + r"|\$\\[A-Za-z]+\$", "", written)
    assert re.findall(r"[\\#$%&_{}^~]", left) == []


def test_names_are_cut_and_never_empty():
    assert len(markdown_text("x" * 1000)) == LONGEST_NAME
    for nothing in ("", " \n", "\x00\u202e"):
        assert markdown_text(nothing) == latex_text(nothing) == "Arm"


def test_accents_and_greek_are_set():
    assert latex_text("Čapek Ångström α½") == r"\v{C}apek \r{A}ngstr\"{o}m $\alpha$1/2"
    assert latex_text("中ą") == "?a"


# --- The formats


@pytest.mark.parametrize("key", ROBOTS)
def test_latex_is_a_whole_article(key):
    text = worksheet(ROBOTS[key], ROBOTS[key].home, "latex")
    assert text.startswith("\\documentclass")
    assert text.endswith("\\end{document}\n")
    assert set(re.findall(r"\\usepackage(?:\[.*?\])?\{(.*?)\}", text)) == {"amsmath", "booktabs", "geometry"}
    assert text.isascii()
    open_ones = []
    for what, name in re.findall(r"\\(begin|end)\{(\w+)\}", text):
        if what == "begin":
            open_ones.append(name)
        else:
            assert open_ones.pop() == name
    assert open_ones == []
    bare = re.sub(r"\\[{}]", "", text)
    assert bare.count("{") == bare.count("}")
    for line in text.replace(r"\$", "").splitlines():
        assert line.count("$") % 2 == 0
    for table in re.findall(r"\\begin\{tabular\}\{(\w+)\}(.*?)\\end\{tabular\}", text, re.DOTALL):
        columns, body = table
        lines = [line for line in body.splitlines() if line.endswith(r" \\")]
        assert {line.count("&") + 1 for line in lines} == {len(columns)}


@pytest.mark.parametrize("key", ROBOTS)
def test_markdown_has_true_minus_signs_and_no_minus_zero(key):
    for format in FORMATS:
        text = worksheet(ROBOTS[key], ROBOTS[key].home, format)
        assert re.findall(r"[−-]0\.0000", text) == []
        if format == "markdown":
            assert re.findall(r"-\d", text) == []
            assert "<table>" in to_html(text, "x.md")


@pytest.mark.parametrize("q", [[0.0], [0.0, math.nan], [[0.0, 0.0]], [0.0, math.inf], [0.0, 0.0, 0.0]])
def test_wrong_joint_values_are_refused(q):
    with pytest.raises(InputError, match="q: expected 2 finite numbers"):
        worksheet(ROBOTS["planar_2r"], q)


def test_unknown_formats_and_units_are_refused():
    with pytest.raises(UnknownName, match=r"format: .*'pdf'.*latex, markdown"):
        worksheet(ROBOTS["planar_2r"], [0.0, 0.0], "pdf")
    with pytest.raises(UnknownName, match=r"angle: .*'grad'.*deg, rad"):
        worksheet(ROBOTS["planar_2r"], [0.0, 0.0], angle="grad")
