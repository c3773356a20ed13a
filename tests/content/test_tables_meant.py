"""Pasted tables that leave something unsaid: rounded angles, whose book it is, what r means."""

import math

import numpy as np
import pytest

from armlab.content.tables import parse_table
from armlab.errors import InputError

H = math.pi / 2
AS_STANDARD = "Read as standard (Siciliano): if your book is Craig's, choose the other convention where it is read."


def same(pasted, rows, atol=1e-12):
    assert "".join(row.kind for row in pasted.rows) == "".join(row[0] for row in rows)
    numbers = [[row.a, row.alpha, row.d, row.theta] for row in pasted.rows]
    np.testing.assert_allclose(numbers, [row[1:] for row in rows], rtol=0, atol=atol)


@pytest.mark.parametrize("written", ["1.5708", "1.571", "1.57", "1.570796", "3.1416/2", "1,5708"])
def test_rounded_quarter_turns_are_exact_and_it_is_said(written):
    pasted = parse_table(f"a;alpha;d;theta\n0.3;{written};0;q1 - {written}\n0.2;-3.14;0;q2")
    same(pasted, [("R", 0.3, H, 0, -H), ("R", 0.2, -2 * H, 0, 0)], atol=0)
    assert any(f"taken as quarter turns: {written} (π/2), q1 - {written} (-π/2), -3.14 (-π)" in n for n in pasted.notes)


@pytest.mark.parametrize("written", ["1.5", "1.5718", "1.58", "1.56", "0.785", "0.0001", "3.1426", "1"])
def test_other_angles_stay_as_they_are_written(written):
    pasted = parse_table(f"a,alpha,d,theta\n0.3,{written},0,q1")
    same(pasted, [("R", 0.3, float(written), 0, 0)], atol=0)
    assert not any("quarter turns" in note for note in pasted.notes)
    same(parse_table(f"a,alpha (deg),d,theta\n0.3,{written},0,q1"), [("R", 0.3, math.radians(float(written)), 0, 0)])


@pytest.mark.parametrize("written", ["q1²", "q1^2", "q1*q1"])
def test_powers_of_a_joint_variable_are_refused(written):
    with pytest.raises(InputError, match=r"expected (the|one) joint variable"):
        parse_table(f"a,alpha,d,theta\n0.3,0,0,{written}")


def test_angles_beyond_a_full_turn_are_told_where_they_are_typed():
    pasted = parse_table("a,alpha,d,theta,offset\n0,90,0,q1 + 270,180\n0.3,0,0,q2 + 270,90\n0.2,0,0,q3 - 300,-100")
    same(pasted, [("R", 0, H, 0, H), ("R", 0.3, 0, 0, 4 * H), ("R", 0.2, 0, 0, math.radians(-40))])
    left_out = "row 1, column theta · row 3, column theta"
    assert pasted.notes[-1] == f"With its offset an angle is beyond a full turn, which is left out: {left_out}."
    for row, place, got in (("0,0,0,q1 + 450,0", "theta", "q1 + 450"), ("0,-361,0,q1,0", "alpha", "-361")):
        with pytest.raises(InputError, match="row 1, column") as refused:
            parse_table(f"a,alpha,d,theta,offset\n{row}")
        assert str(refused.value) == f"row 1, column {place}: expected at most a full turn either way, got {got!r}"


FRAMES = (
    "┌─┬┐ │ ├─┼┤ └─┴┘",
    "┏━┳┓ ┃ ┣━╋┫ ┗━┻┛",
    "╔═╦╗ ║ ╠═╬╣ ╚═╩╝",
    "╒═╤╕ │ ╞═╪╡ ╘═╧╛",
    "╭─┬╮ │ ├─┼┤ ╰─┴╯",
    "┍━┯┑ │ ┝━┿┥ ┕━┷┙",
)
"""Lines above, between the cells, between the rows and below, as programs draw them."""


@pytest.mark.parametrize("frame", FRAMES)
def test_a_drawn_table_may_have_lines_of_any_kind_and_another_table_below_is_not_read(frame):
    above, bar, between, below = (
        part if len(part) == 1 else part[0] + part[1] * 3 + part[2:] for part in frame.split()
    )
    lines = [bar.join(("", *cells.split(), "")) for cells in ("θⱼ dⱼ aⱼ ⍺ⱼ", "q1 0.4 0 90°", "q2 0 0.5 0°")]
    drawn = "\n".join([above, lines[0], between, lines[1], lines[2], below])
    same(parse_table(f"{drawn}\n{above}\n{bar}tool{bar}0{bar}\n{below}"), [("R", 0, H, 0.4, 0), ("R", 0.5, 0, 0, 0)])


# --- Conventions

KHALIL = r"""
\begin{tabular}{ccccccc}
$j$ & $a(j)$ & $\sigma_j$ & $\alpha_j$ & $d_j$ & $\theta_j$ & $r_j$ \\ \hline
1 & 0 & 0 & 0 & 0 & $\theta_1$ & 0 \\
2 & 1 & 0 & $\pi/2$ & 0.1 & $\theta_2$ & 0.2 \\
3 & 2 & 1 & $-\pi/2$ & 0.4 & 0 & $r_3$ \\
\end{tabular}
"""


def test_khalil_and_dombre_have_d_along_x_and_r_along_z():
    rows = [("R", 0, 0, 0, 0), ("R", 0.1, H, 0.2, 0), ("P", 0.4, -H, 0, 0)]
    without_sigma = "j,alpha_j,d_j,theta_j,r_j\n1,0,0,q1,0\n2,pi/2,0.1,q2,0.2\n3,-pi/2,0.4,0,r3"
    for text in (KHALIL, without_sigma):
        pasted = parse_table(text)
        assert pasted.convention == "modified"
        same(pasted, rows)
        assert "Columns d and r as in Khalil's book: d is read as a(i-1), r as d." in pasted.notes
        assert "Khalil's tables are of the modified convention." in pasted.notes


def test_r_beside_alpha_and_d_beside_theta_is_the_length_along_x():
    pasted = parse_table("d,theta,r,alpha\n0.4,q1,0.3,pi/2")
    assert pasted.convention == "standard"
    same(pasted, [("R", 0.3, H, 0.4, 0)])
    assert "The column r is read as a, the length along x." in pasted.notes


def test_a_column_sigma_beside_a_is_only_the_type():
    pasted = parse_table("theta,d,a,alpha,sigma\nq1,0.4,0.3,pi/2,0\n0,q2,0,0,1")
    same(pasted, [("R", 0.3, H, 0.4, 0), ("P", 0, 0, 0, 0)])
    assert pasted.convention == "standard"


def test_r_is_no_joint_variable_elsewhere():
    for text in ("a,alpha,d,theta\n0,0,r1,0", "a,alpha,d,theta\n0,0,0,r1", "alpha,d,theta,r\n0,0,0,d1"):
        with pytest.raises(InputError, match=r"the joint variable (of this column|is in theta or d)"):
            parse_table(text)


ROW = "a | alpha | d | theta\n0.3 | pi/2 | 0 | q1\n0.2 | 0 | 0 | q2\n"


@pytest.mark.parametrize(
    ("around", "convention", "note"),
    [
        ("", "standard", AS_STANDARD),
        ("Table 3.2 of Craig", "modified", "Read as modified, because the text names a book with this convention."),
        ("MDH", "modified", "Read as modified, because the text names a book with this convention."),
        ("after Spong et al.", "standard", "Read as standard, because the text names a book with this convention."),
        ("Siciliano, not Craig", "standard", AS_STANDARD),
        ("modified 2024; proximal phalanx of a classic hand", "standard", AS_STANDARD),
        ("Modified D-H parameters", "modified", None),
        ("DH (proximal)", "modified", None),
        ("Modified D–H parameters", "modified", None),
        ("Non-standard DH parameters", "standard", AS_STANDARD),
        ("Non‑standard DH parameters", "standard", AS_STANDARD),
        ("Not modified DH, but standard DH", "standard", None),
        (
            "These are not the standard DH parameters, but those of Craig:",
            "modified",
            "Read as modified, because the text names a book with this convention.",
        ),
        ("the classical Denavit-Hartenberg table", "standard", None),
        ("distal convention", "standard", None),
    ],
)
def test_words_around_the_table_tell_the_convention_and_it_is_said(around, convention, note):
    pasted = parse_table(f"{around}\n\n{ROW}")
    assert pasted.convention == convention
    assert [n for n in pasted.notes if "Read as" in n or "convention" in n] == ([note] if note else [])


def test_the_default_and_the_headers_are_notes():
    assert (
        "Read as modified (Craig): if your book is Siciliano's, choose the other convention where it is read."
        in parse_table(ROW, "modified").notes
    )
    craig = parse_table("alpha,a,d,theta\n0,0.3,0,q1")
    assert craig.convention == "standard"
    assert any("the columns stand in Craig's order" in note for note in craig.notes)
    headed = parse_table("by Craig\na_i,alpha_i,d_i,theta_i\n0,0.3,0,q1")
    assert headed.convention == "standard"
    assert any("though the text names a book with the modified one" in note for note in headed.notes)


FRANKA = """Joint, a (mm), d (mm), alpha (rad), theta (rad)
Joint 1, 0, 333, 0, θ1
Joint 2, 0, 0, -π/2, θ2
Joint 3, 0, 316, π/2, θ3
Joint 4, 82.5, 0, π/2, θ4
Joint 5, -82.5, 384, -π/2, θ5
Joint 6, 0, 0, π/2, θ6
Joint 7, 88, 0, π/2, θ7
Flange, 0, 107, 0, 0"""


def test_a_table_in_which_two_joints_would_turn_about_one_line_is_read_in_the_other_convention_and_it_is_said():
    pasted = parse_table(FRANKA)
    assert pasted.convention == "modified"
    assert pasted.notes[1] == (
        "Read as modified (Craig), because as standard joints 1 and 2 would turn about the same line: "
        "if your book is Siciliano's, choose the other convention where it is read."
    )
    wrist = "a,alpha,d,theta\n0,-90,0.4,q1\n0,90,0,q2\n0,0,0.1,q3"
    assert parse_table(wrist).notes[0] == AS_STANDARD
    assert parse_table(FRANKA, "standard").convention == "standard"
    assert parse_table(wrist, "modified").convention == "modified"
    slides = "a,alpha,d,theta\n0,0,d1,0\n0.2,90,d2,0\n0,90,d3,0"
    assert "joints 1 and 2 would slide in the same direction" in parse_table(slides).notes[0]


@pytest.mark.parametrize(
    "rows",
    [
        "0,0,0.4,q1\n0,-90,d2,0\n0,0,d3,0",  # a cylindrical arm: the first joint turns about the line of the second
        "0.3,0,0,q1\n0.2,180,0,q2\n0,0,d3,0\n0,0,0.1,q4",  # a SCARA
        "0,0,0.4,q1\n0,0,0.1,q2\n0,0,0,q3",  # in both
    ],
)
def test_a_table_that_is_possible_in_its_convention_or_in_none_stays_standard(rows):
    assert parse_table(f"a,alpha,d,theta\n{rows}").notes[0] == AS_STANDARD


def test_a_first_row_as_in_craig_is_a_hint_only():
    pasted = parse_table("a,alpha,d,theta\n0,0,0.4,0\n0.3,pi/2,0,0\n0.1,pi/2,0,0")
    assert pasted.convention == "standard"
    assert pasted.notes[0].endswith(
        "a and alpha of the first row are 0, as in Craig's: if it is his, choose the other convention where it is read."
    )
    assert parse_table("DH (standard)\n" + FRANKA).convention == "standard"


# --- Rows that may be joints or not


def test_a_row_with_a_joint_variable_is_a_joint_whatever_it_is_called():
    rows = "Base,0,90,d1,0\n1,0.3,0,0,q2\nGripper,0,0,0.1,q3\nTCP,0,0,0.2,0\nWorld,0,0,0,0"
    pasted = parse_table(f"joint,a,alpha (deg),d,theta\n{rows}")
    same(pasted, [("P", 0, H, 0, 0), ("R", 0.3, 0, 0, 0), ("R", 0, 0, 0.1, 0)])
    assert pasted.notes[0] == "Not read, because it is not a joint: TCP 0 0 0.2 0; World 0 0 0 0."
    with_tool = parse_table(f"joint,a,alpha (deg),d,theta\n{rows.partition('World')[0]}")
    assert (with_tool.rows, [row.d for row in with_tool.flange]) == (pasted.rows, [0.2])


# --- Files and programs

LINKS = """% Peter Corke's toolbox, first figures of a PUMA
L(1) = Link([0 0.6718 0 pi/2]);
L(2) = Link([ 0, 0, 0.4318, 0, 0, -pi/2 ]);  % with an offset
L(3) = Link([pi/2 0 0.02 -pi/2 1 0.1]);
bot = SerialLink(L, 'name', 'half');"""


def test_links_of_a_toolbox_are_read_in_its_order_and_convention():
    pasted = parse_table(LINKS)
    assert (pasted.convention, pasted.notes) == ("standard", ())
    same(pasted, [("R", 0, H, 0.6718, 0), ("R", 0.4318, 0, 0, -H), ("P", 0.02, -H, 0.1, H)])
    modified = parse_table(LINKS.replace("]);", "], 'modified');"))
    assert modified.convention == "modified"
    assert modified.rows == pasted.rows


@pytest.mark.parametrize(
    ("beside", "notes"),
    [
        ("%{\nL(4) = Link([0 0 9 0]);\nL(1).mdh = 1;\n%}", ()),
        ("# L4 = Link([0, 0, 9, 0])", ()),
        ("L(1).qlim = [-pi pi]; if L(1).offset == 0, end", ()),
        ("bot = SerialLink(L, 'tool', transl(0, 0, 0.1));", ("Not read: tool.",)),
        ("bot.tool = transl(0, 0, 0.1); bot.base = trotx(pi);", ("Not read: base and tool.",)),
        ("arm = DHRobot(L, base=SE3(0, 0, 1))", ("Not read: base.",)),
    ],
)
def test_what_stands_beside_the_links_of_a_program_is_told_when_it_is_not_read(beside, notes):
    pasted = parse_table(f"{LINKS}\n{beside}")
    assert (pasted.rows, pasted.convention, pasted.notes) == (parse_table(LINKS).rows, "standard", notes)


FORMS = "paste its Denavit-Hartenberg table instead, a row with a, alpha, d, theta for each joint: from a spreadsheet"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            '<robot name="x"><joint name="j1" type="revolute"/></robot>',
            f"a URDF or another file in XML is not .*{FORMS}",
        ),
        ('<?xml version="1.0"?>\n<robot name="x">\n</robot>', f"a URDF or another file in XML is not read; {FORMS}"),
        ('body = rigidBody("body1");\nsetFixedTransform(jnt1,dh(1,:),"dh");', f"only Link.* is read; {FORMS}"),
        ("robot = DHRobot([RevoluteDH(d=0.67, alpha=pi/2)])", f"only Link.* is read; {FORMS}"),
        ("L(1) = Link('d', 0.4, 'a', 0, 'alpha', pi/2);", f"only Link.* is read; {FORMS}"),
        ("L(1) = Link([0 0.4 0]);", "link 1: expected theta, d, a, alpha, perhaps sigma and offset, got 3 numbers"),
        ("Link([0 0 1 0 2])", r"link 1: expected sigma 0 \(turns\) or 1 \(slides\), got '2'"),
        ("Link([0 0 1 0])\nLink([0 0 1 0], 'modified')", "expected all links in one convention"),
        (f"{LINKS}\nL(4) = Link('d', 0, 'a', 0.3, 'alpha', 0);", f"only Link.* is read; {FORMS}"),
        (f"{LINKS}\nL(4) = Link(row);", f"only Link.* is read; {FORMS}"),
        (f"{LINKS}\nL(2).offset = -pi/2;", rf"about a link inside Link.*, got 'L\(2\).offset ='; {FORMS}"),
        (f"{LINKS}\nL(1).mdh = 1;", r"about a link inside Link\(.*, 'modified'\), got 'L\(1\).mdh ='"),
        ("bot = SerialLink(Link([0 0 1 0]), 'offset', [1])", "about a link inside Link.*, got \"'offset'\""),
        ("L1 = Link([0, 0, 1, 0], mdh=True)", "about a link inside Link.*, got 'mdh=True'"),
        ("a (in),alpha (deg),d (in),theta (deg)\n12,0,0,q1", r"column a: expected m, cm or mm, got 'a \(in\)'"),
        ("a,alpha [grad],d,theta\n12,0,0,q1", r"column alpha: expected deg or rad, got 'alpha \[grad\]'"),
    ],
)
def test_other_files_programs_and_units_are_refused_with_what_can_be_pasted(text, says):
    with pytest.raises(InputError, match=says):
        parse_table(text)


def test_words_of_programs_may_stand_in_a_table():
    text = "Link (number),a,alpha,d,theta,type\n1,0.3,90,0,q1,Revolute\n2,0.2,0,0,q2,Revolute"
    same(parse_table(text), [("R", 0.3, H, 0, 0), ("R", 0.2, 0, 0, 0)])
