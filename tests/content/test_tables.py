"""Tables as people paste them."""

import math
from functools import cache

import numpy as np
import pytest

from armlab.content.tables import parse_table
from armlab.content.write_table import ANGLE_UNITS, FORMATS, write_table
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from support.arms import random_arm

H = math.pi / 2
AS_STANDARD = "Read as standard (Siciliano): if your book is Craig's, choose the other convention where it is read."


def numbers(rows):
    return [[row.a, row.alpha, row.d, row.theta] for row in rows]


def same(pasted, rows, atol=1e-12):
    assert "".join(row.kind for row in pasted.rows) == "".join(row[0] for row in rows)
    np.testing.assert_allclose(numbers(pasted.rows), [row[1:] for row in rows], rtol=0, atol=atol)


def as_rows(arm):
    return [(row.kind, row.a, row.alpha, row.d, row.theta) for row in arm.rows]


# --- What books and programs give

CRAIG_PUMA = r"""
\begin{table}[h]
\centering % Craig, figure 3.21
\begin{tabular}{|c|c|c|c|c|}
\hline
$i$ & $\alpha_{i-1}$ & $a_{i-1}$ & $d_i$ & $\theta_i$ \\ \hline\hline
1 & 0 & 0 & 0 & $\theta_1$ \\ \hline
2 & $-90^{\circ}$ & 0 & 0 & $\theta_2$ \\ \hline
3 & 0 & 0.4318 & 0.1501 & $\theta_3$ \\ \hline
4 & $-90^\circ$ & 0.0203 & 0.4331 & $\theta_4$ \\ \hline
5 & $90^\circ$ & $0$ & $0$ & $\theta_5$ \\ \hline
6 & $-90\degree$ & 0 & 0 & $\theta_6$ \\[2pt]
\hline
\end{tabular}
\caption{Link parameters of the PUMA 560.}
\end{table}
"""

SICILIANO_ANTHROPOMORPHIC = """
| Link | aᵢ | αᵢ  | dᵢ | ϑᵢ |
|:----:|:--:|:---:|:--:|:--:|
| 1    | 0  | π/2 | 0  | ϑ₁ |
| 2    | 0.8 | 0  | 0  | ϑ₂ |
| 3    | 0.5 | 0  | 0  | ϑ₃ |

Table 2.3: the anthropomorphic arm.
"""

CORKE_STANFORD = """DHRobot.Stanford: Stanford arm, 6 joints (RRPRRR), dynamics, standard DH parameters
┌────────┬───────┬────────┬────────┬─────────┬────────┐
│   θⱼ   │  dⱼ   │   aⱼ   │   ⍺ⱼ   │   q⁻    │   q⁺   │
├────────┼───────┼────────┼────────┼─────────┼────────┤
│  q1    │ 0.412 │      0 │ -90.0° │ -170.0° │ 170.0° │
│  q2    │ 0.154 │      0 │  90.0° │ -170.0° │ 170.0° │
│ -90.0° │    q3 │ 0.0203 │   0.0° │  0.3048 │   1.27 │
│  q4    │     0 │      0 │ -90.0° │ -170.0° │ 170.0° │
│  q5    │     0 │      0 │  90.0° │  -90.0° │  90.0° │
│  q6    │     0 │      0 │   0.0° │ -170.0° │ 170.0° │
└────────┴───────┴────────┴────────┴─────────┴────────┘

┌──────┬─────┬─────┬────┬─────┬─────┬─────┐
│ name │ q0  │ q1  │ q2 │ q3  │ q4  │ q5  │
├──────┼─────┼─────┼────┼─────┼─────┼─────┤
│   qr │  0° │  0° │  0 │  0° │  0° │  0° │
└──────┴─────┴─────┴────┴─────┴─────┴─────┘
"""

CORKE_MODIFIED = """DHRobot: x, 2 joints (RR), modified DH parameters
┌──────┬───────┬─────────────┬─────┐
│ aⱼ₋₁ │ ⍺ⱼ₋₁  │     θⱼ      │ dⱼ  │
├──────┼───────┼─────────────┼─────┤
│  0.1 │ 90.0° │  q1 + 17.2° │ 0.0 │
│  0.2 │  0.0° │          q2 │ 0.0 │
└──────┴───────┴─────────────┴─────┘
"""

SPONG_STANFORD = r"""
\[ \begin{array}{c|cccc}
\text{Link} & d_i & a_i & \alpha_i & \theta_i \\ \hline
1 & 0 & 0 & -\frac{\pi}{2} & \theta_1^* \\
2 & 0.154 & 0 & +\frac{\pi}{2} & \theta_2^{*} \\
3 & d_3^* & 0 & 0 & 0 \\
\end{array} \]
"""


def test_craig_in_latex_is_modified_and_in_degrees():
    pasted = parse_table(CRAIG_PUMA)
    assert pasted.convention == "modified"
    assert any("modified convention (Craig)" in note for note in pasted.notes)
    same(
        pasted,
        [
            ("R", 0, 0, 0, 0),
            ("R", 0, -H, 0, 0),
            ("R", 0.4318, 0, 0.1501, 0),
            ("R", 0.0203, -H, 0.4331, 0),
            ("R", 0, H, 0, 0),
            ("R", 0, -H, 0, 0),
        ],
    )


def test_siciliano_in_markdown():
    pasted = parse_table(SICILIANO_ANTHROPOMORPHIC)
    assert pasted.convention == "standard"
    same(pasted, [("R", 0, H, 0, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)])


def test_corke_as_printed_with_a_sliding_joint_and_a_second_table():
    pasted = parse_table(CORKE_STANFORD, default_convention="modified")
    assert pasted.convention == "standard"
    same(
        pasted,
        [
            ("R", 0, -H, 0.412, 0),
            ("R", 0, H, 0.154, 0),
            ("P", 0.0203, 0, 0, -H),
            ("R", 0, -H, 0, 0),
            ("R", 0, H, 0, 0),
            ("R", 0, 0, 0, 0),
        ],
    )
    assert pasted.notes == ("Not read: the columns q-, q+.",)


def test_corke_modified_with_an_offset():
    pasted = parse_table(CORKE_MODIFIED)
    assert pasted.convention == "modified"
    same(pasted, [("R", 0.1, H, 0, math.radians(17.2)), ("R", 0.2, 0, 0, 0)])


def test_the_toolbox_itself_prints_what_we_read():
    rtb = pytest.importorskip("roboticstoolbox")
    for model in (rtb.models.DH.Puma560(), rtb.models.DH.Stanford()):
        pasted = parse_table(str(model))
        # It prints angles with one decimal and lengths with four digits.
        rows = [
            ("P" if link.isprismatic else "R", link.a, link.alpha, link.d, link.theta + link.offset)
            for link in model.links
        ]
        same(pasted, rows, atol=1e-3)


def test_spong_marks_variables_with_stars():
    same(parse_table(SPONG_STANFORD), [("R", 0, -H, 0, 0), ("R", 0, H, 0.154, 0), ("P", 0, 0, 0, 0)])


def test_a_matrix_without_a_header():
    text = r"\begin{bmatrix} 0 & \pi/2 & 0.4 & \theta_1 \\ 1 & 0 & 0 & \theta_2 - \frac{\pi}{2} \end{bmatrix}"
    pasted = parse_table(text)
    same(pasted, [("R", 0, H, 0.4, 0), ("R", 1, 0, 0, -H)])
    assert "There is no header; the columns are taken as a, alpha, d, theta." in pasted.notes


def test_the_order_of_a_table_without_a_header_can_be_given():
    same(parse_table("q1, 0.4, 0, pi/2\nq2, 0, 1, 0", order=("theta", "d", "a", "alpha")), [
        ("R", 0, H, 0.4, 0),
        ("R", 1, 0, 0, 0),
    ])  # fmt: skip


def test_a_joint_number_or_a_type_may_come_first():
    same(parse_table("1, 0, pi/2, 0.4, 0\n2, 1, 0, 0, 0"), [("R", 0, H, 0.4, 0), ("R", 1, 0, 0, 0)])
    same(parse_table("R 0 90 0.4 0\nP 1 0 0.2 0"), [("R", 0, H, 0.4, 0), ("P", 1, 0, 0.2, 0)])


def test_a_spreadsheet_with_decimal_commas():
    text = "Joint\ta [mm]\tα (°)\td [mm]\tθ (°)\n1\t0\t90\t127,3\tq1\n2\t-612,0\t0\t0\tq2 - 90\n"
    same(parse_table(text), [("R", 0, H, 0.1273, 0), ("R", -0.612, 0, 0, -H)])
    same(parse_table(text.replace("\t", ";")), [("R", 0, H, 0.1273, 0), ("R", -0.612, 0, 0, -H)])
    with pytest.raises(InputError, match=r"row 1: expected 5 cells, got 6"):
        parse_table(text.replace("\t", ","))


def test_an_offset_column_and_a_type_column():
    text = "a,alpha,d,theta,type,offset\n0.5,0,0.1,q1 + pi,revolute,pi/2\n0,pi,0.2,0,prismatic,0.3"
    same(parse_table(text), [("R", 0.5, 0, 0.1, 3 * H), ("P", 0, math.pi, 0.5, 0)])


def test_symbols_of_print_are_understood():
    same(parse_table("a | α | d | θ\n0 | −π⁄2 | 0 | θ₁ − 90°"), [("R", 0, -H, 0, -H)])


MANUFACTURER = """UR10e\t\t\t\t\t\t\t
Kinematics\ttheta [rad]\ta [m]\td [m]\talpha [rad]\tDynamics\tMass [kg]\tCenter of Mass [m]
Joint 1\t0\t0\t0.1807\tπ/2\tLink 1\t7.369\t[0.021, 0.000, 0.027]
Joint 2\t0\t-0.6127\t0\t0\tLink 2\t13.051\t[0.38, 0.000, 0.158]
"""

SIUNITX = r"""\begin{tabular}{S[table-format=1.1]ccc}\toprule
$\boldsymbol{\theta_{i}}$ & $\mathbf{d_i}$ (mm) & $a_{i}$ (mm) & $\boldsymbol{\alpha}_{i}$ \\ \midrule
$\theta_{1}$ & \SI{290}{\milli\meter} & \num{0} & \ang{-90} \\
$\theta_{2} - \SI{90}{\degree}$ & 0 & 270 & $0^{\circ}$ \\ \bottomrule
\end{tabular}"""


def test_a_page_of_a_manufacturer_with_a_title_and_masses():
    pasted = parse_table(MANUFACTURER)
    same(pasted, [("R", 0, H, 0.1807, 0), ("R", -0.6127, 0, 0, 0)])
    assert "Not read: the columns Kinematics, Dynamics, Mass [kg], Center of Mass [m]." in pasted.notes


def test_latex_with_units():
    same(parse_table(SIUNITX), [("R", 0, -H, 0.29, 0), ("R", 0.27, 0, 0, -H)])


def test_a_flange_is_no_joint_and_it_is_said():
    text = "Joint | a (m) | d (m) | α (rad) | θ (rad)\nJoint 1 | 0 | 0.333 | 0 | θ1\nFlange | 0 | 0.107 | 0 | 0"
    pasted = parse_table(text)
    same(pasted, [("R", 0, 0, 0.333, 0)])
    assert [(row.a, row.alpha, row.d, row.theta) for row in pasted.flange] == [(0, 0, 0.107, 0)]
    assert pasted.notes == ("Read as the tool, because it is not a joint: Flange 0 0.107 0 0.", AS_STANDARD)
    for row in ("Base | 0 | 0.107 | 0 | 0", "Flange | | | |"):
        pasted = parse_table(text.replace("Flange | 0 | 0.107 | 0 | 0", row))
        assert not pasted.flange
        assert pasted.notes[0].startswith("Not read, because it is not a joint: ")


@pytest.mark.parametrize("text", ["[[0, pi/2, 0.4, q1],\n [1, 0, 0, q2]]", "[0 pi/2 0.4 q1; 1 0 0 q2]"])
def test_lists_of_programs(text):
    same(parse_table(text), [("R", 0, H, 0.4, 0), ("R", 1, 0, 0, 0)])


# --- Units that nobody wrote


def test_large_angles_are_degrees_and_large_lengths_millimetres():
    pasted = parse_table("a,alpha,d,theta\n431.8,-90,0,q1\n0,90,150,q2")
    same(pasted, [("R", 0.4318, -H, 0, 0), ("R", 0, H, 0.15, 0)])
    assert any("taken as degrees" in note for note in pasted.notes)
    assert any("taken as millimetres" in note for note in pasted.notes)


def test_small_angles_are_radians_and_it_is_said():
    pasted = parse_table("a,alpha,d,theta\n1,1.5,0,q1")
    same(pasted, [("R", 1, 1.5, 0, 0)])
    assert pasted.notes == (AS_STANDARD, "Angles without a unit are taken as radians.")


def test_one_marked_angle_makes_the_others_degrees():
    same(parse_table("a,alpha,d,theta\n0,90°,0,q1\n0,3,0,q2"), [("R", 0, H, 0, 0), ("R", 0, math.radians(3), 0, 0)])


def test_pi_is_radians_even_beside_degrees():
    pasted = parse_table("a,alpha [deg],d,theta\n0,pi/2,0,q1\n0,45,0,q2")
    same(pasted, [("R", 0, H, 0, 0), ("R", 0, H / 2, 0, 0)])
    assert any("row 1, column alpha" in note for note in pasted.notes)


def test_nothing_marked_is_revolute_and_it_is_said():
    pasted = parse_table("a,alpha,d,theta\n1,0,0,pi/2")
    same(pasted, [("R", 1, 0, 0, H)])
    assert pasted.notes == (
        AS_STANDARD,
        "No joint variable is marked in row 1: taken as revolute, with theta its offset.",
    )


# --- Our own


def test_print_of_an_arm(robot):
    arm = robot.arm
    pasted = parse_table(str(arm))
    assert pasted.convention == arm.convention
    same(pasted, as_rows(arm), atol=1e-5)  # six digits are printed


@cache
def drawn(most, convention=None):
    """Return random arms of up to so many joints, half of them special: the same ones for every way to write them."""
    rng = np.random.default_rng(20260)
    lengths = [*range(1, most + 1), *rng.integers(1, most + 1, 24 - most)]
    return [random_arm(rng, int(n), convention=convention, special=bool(i // 2 % 2)) for i, n in enumerate(lengths)]


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("angle", ANGLE_UNITS)
def test_what_is_written_is_read_back(format, angle):
    for arm in drawn(12):
        default = "modified" if arm.convention == "standard" else "standard"
        pasted = parse_table(write_table(arm, format, angle), default_convention=default)
        assert pasted.convention == arm.convention
        same(pasted, as_rows(arm))


def test_tiny_and_huge_numbers_are_read_back():
    rows = [("R", 1e-12, 1e-9, 25.0, -1e-17), ("P", -0.0, 6.25, 1e5, -6.28)]
    for format in FORMATS:
        for angle in ANGLE_UNITS:
            same(parse_table(write_table(Arm.from_dh(rows), format, angle)), rows)


@pytest.mark.parametrize("style", ["comma", "tab", "semicolon", "bars", "latex", "blanks"])
def test_random_tables_in_random_order_of_columns(style, rng):
    joint = {"comma": ",", "tab": "\t", "semicolon": ";", "bars": " | ", "latex": " & ", "blanks": "   "}[style]
    end = r" \\" if style == "latex" else ""
    for arm in drawn(7, "standard"):
        order = list(rng.permutation(["a", "alpha", "d", "theta"]))
        lines = [joint.join(order) + end]
        for i, row in enumerate(arm.rows, start=1):
            cells = {name: repr(getattr(row, name)) for name in order}
            variable = "theta" if row.revolute else "d"
            symbol = str(rng.choice([f"q{i}", f"{variable}_{i}", f"{variable}{i}*"]))
            cells[variable] = f"{symbol} + {cells[variable]}".replace("+ -", "- ")
            lines.append(joint.join(cells[name] for name in order) + end)
        same(parse_table("\n".join(lines)), as_rows(arm))


def test_a_format_that_does_not_exist():
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)])
    with pytest.raises(UnknownName, match=r"format: unknown name 'html'"):
        write_table(arm, "html")
    with pytest.raises(UnknownName, match=r"angle: unknown name 'grad'"):
        write_table(arm, "csv", "grad")


# --- Mistakes


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "expected one row for each joint, got nothing"),
        ("a,alpha,d,theta", "expected 1 to 12 rows, one for each joint, got 0"),
        ("a,alpha,d,theta\n" + "0,0,0,q\n" * 13, "expected 1 to 12 rows, one for each joint, got 13"),
        ("a,alpha,d,theta\n0,0,0,q1\n0,0,q2", "row 2: expected 4 cells, got 3"),
        ("a,alpha,d,theta\n0,ninety,0,q1", "row 1, column alpha: expected a number such as 90, .* got 'ninety'"),
        ("a,alpha,d,theta\n0,0,0,q1\n0,,0,q2", "row 2, column alpha: expected a number .* got ''"),
        (
            "a,alpha,d,theta\na1,0,0,q1",
            "column a: expected a number .* got 'a1'; write the value of this constant",
        ),
        ("a,alpha,d,theta\nq1,0,0,0", "row 1, column a: expected a number; the joint variable is in theta or d"),
        ("a,alpha,d,theta\n0,0,d1,theta1", "row 1: 'theta1' and 'd1' both look like the joint variable"),
        ("a,alpha,d,theta\n0,0,d1,theta1*", "row 1, column d: expected a number, because the joint is revolute"),
        ("a,alpha,d,theta\n0,0,0,-q1", "row 1, column theta: expected the joint variable plus a number, got '-q1'"),
        ("a,alpha,d,theta\n0,0,0,q1+q2", "row 1, column theta: expected one joint variable, got"),
        ("a,alpha,d,theta,type\n0,0,0,0,X", "row 1, column type: expected a joint number or R .* got 'X'"),
        ("a,alpha,d,theta,type\n0,0,q1,0,R", "row 1, column d: expected a number, because the joint is revolute"),
        ("a,alpha,d,theta\n0,0.3 m,0,q1", "row 1, column alpha: expected an angle, got '0.3 m'"),
        ("a,alpha,d,theta\npi/2,0,0,q1", "row 1, column a: expected a length, got 'pi/2'"),
        ("a,alpha,theta\n0,0,q1", "the header: expected one column d, got none; the columns are a, alpha, theta"),
        ("a,alpha,d,d,theta\n0,0,0,0,q1", "the header: expected one column d, got 2 of them"),
        ("a_{i-1},alpha_i,d,theta\n0,0,0,q1", r"a\(i-1\) is of the modified convention and alpha\(i\) of the stand"),
        ("a [deg],alpha,d,theta\n0,0,0,q1", "column a: expected m, cm or mm, got 'a \\[deg\\]'"),
        ("x,y,z,w\n0,0,0,q1", "the header: expected names of a, alpha, d, theta .* got x, y, z, w"),
        ("0,0,0\n1,1,1", "row 1: expected a, alpha, d, theta, perhaps after a joint number or R/P, got 3 cells"),
        ("a;alpha;d;theta\n0;1,2,3;0;q1", "row 1, column alpha: expected a number"),
        (r"\begin{tabular}{c} a & \alpha & d & \theta \\ 0", r"begin\{tabular\} has no"),
        ("a,alpha,d,theta\n0,__import__('os'),0,q1", "row 1, column alpha: expected a number"),
        ("a,alpha,d,theta\n0,9**9**9**9,0,q1", "row 1, column alpha: expected a number"),
        ("x" * 30_000, "expected at most 20000 characters, got 30000"),
    ],
)
def test_mistakes_are_named_with_row_and_column(text, says):
    with pytest.raises(InputError, match=says):
        parse_table(text)


def test_wrong_arguments():
    with pytest.raises(UnknownName, match="convention: unknown name 'craig'"):
        parse_table("0,0,0,q1", default_convention="craig")
    with pytest.raises(InputError, match=r"order: expected the columns a, alpha, d, theta, each once"):
        parse_table("0,0,0,q1", order=("a", "d"))


def test_nothing_but_an_input_error_comes_out_of_noise(rng):
    pieces = ["a", "α", "&", r"\\", "|", ",", ";", "\t", "\n", "q1", "90", "°", "π", "^", "(", "-", r"\frac{", "}", '"']
    read, refused = 0, []
    for _ in range(1500):
        text = "".join(rng.choice(pieces, size=int(rng.integers(1, 60))))
        try:
            read += len(parse_table(text).rows) > 0
        except InputError as error:
            refused.append(str(error))
    assert read + len(refused) == 1500
    assert min(map(len, refused)) > 10
