"""Texts that people paste as tables, at least one for every sentence that the lab says of them."""

from __future__ import annotations

from collections.abc import Iterator

from armlab.content.tables import parse_table
from armlab.errors import InputError

HEAD = "a,alpha,d,theta\n"
PRINT = "standard DH, 1 joint\njoint  a, m  alpha, deg  d, m  theta, deg\n1  0.3  0  0  q1\n"

NOTED = (
    f"{HEAD}1,1.5,0,q1",
    f"{HEAD}1,0,0,pi/2",
    f"{HEAD}1,0,0,0\n1,0,0,0",
    f"{HEAD}431.8,-90,0,q1\n0,90,150,q2",
    f"{HEAD}0,90°,0,q1\n0,3,0,q2",
    f"{HEAD}0.3,1.57,0,q1 - 1.5708",
    f"{HEAD}0,-90,0,q1\n0.2,90,d2,0",
    f"{HEAD}0,0,0.4,q1\n0.2,90,0,q2\n0,90,0.1,q3",
    f"{HEAD}0,0,d1,0\n0.2,90,d2,0\n0,90,d3,0",
    f"{HEAD}0,0,0.4,0\n0.3,pi/2,0,0",
    f"Craig, page 77\n\n{HEAD}0.3,0,0,q1",
    f"Siciliano, page 77\n\n{HEAD}0.3,0,0,q1",
    "DH (standard)\na,alpha,d,theta\n0.3,0,0,q1",
    "alpha,a,d,theta\n0,0.3,0,q1",
    "a_i,alpha_i,d_i,theta_i\n0.3,0,0,q1",
    "a_{i-1},alpha_{i-1},d_i,theta_i\n0.3,0,0,q1",
    "by Craig\na_i,alpha_i,d_i,theta_i\n0.3,0,0,q1",
    "by Siciliano\na_{i-1},alpha_{i-1},d_i,theta_i\n0.3,0,0,q1",
    "a,alpha [deg],d,theta\n0,pi/2,0,q1\n0,45,0,q2\n0,pi,0,q3 - pi/2",
    "a,alpha,d,theta,min,max\n0.3,0,0,q1,-1,1",
    "joint,a,alpha,d,theta,Mass [kg]\n1,0.3,0,0,q1,7.4",
    "j,alpha_j,d_j,theta_j,r_j\n1,0,0,q1,0\n2,pi/2,0.1,q2,0.2",
    "d,theta,r,alpha\n0.4,q1,0.3,pi/2",
    "a,alpha,d,theta,offset\n0,90,0,q1 + 270,180\n0.3,0,0,q2,0\n0.2,0,0,q3 - 300,-100",
    "0 0 0.4 q1\n1 0 0 q2",
    "joint,a,alpha,d,theta\n1,0,0,0.3,q1\nflange,0,0,0.1,0",
    "joint,a,alpha,d,theta\nbase,0,0,0.3,0\n1,0,0,0.3,q1\n2,0,0,0.3,q2",
    f"{PRINT}base: x\ntool: x",
    f"{PRINT}base: x",
    f"{PRINT}tool: x",
    "L(1) = Link([0 0.4 0.1 -pi/2], 'modified');",
)
"""Tables that are read, with notes about what is not written in them."""

REFUSED = (
    "",
    "----",
    " " * 20_001,
    "1 " * 61,
    HEAD,
    HEAD + "0,0,0,q\n" * 13,
    f"{HEAD}0,0,0,q1\n0,0,q2",
    f"{HEAD}0,ninety,0,q1",
    f"{HEAD}0,,0,q1",
    f"{HEAD}a1,0,0,q1",
    f"{HEAD}q1,0,0,0",
    f"{HEAD}0,0,theta1,0",
    f"{HEAD}0,0,d1,theta1",
    f"{HEAD}0,0,d1,theta1*",
    f"{HEAD}0,0,d1*,theta1",
    f"{HEAD}0,0,0,-q1",
    f"{HEAD}0,0,0,q1+q2",
    f"{HEAD}0,90 deg + 1 rad,0,q1",
    f"{HEAD}0,0.3 m,0,q1",
    f"{HEAD}pi/2,0,0,q1",
    f"{HEAD}1.2.3,0,0,q1",
    f"{HEAD}1,0,0,q1 + 450",
    f"{HEAD}1,9**9**9,0,q1",
    'a,alpha,d,theta\n"0,5",0,0,q1',
    "a,alpha,d,theta,type\n0,0,0,0,X",
    "joint,a,alpha,d,theta\nelbow,0,0,0,q1",
    "a,alpha,d,theta,variable\n0,0,0,0,r p",
    "a,alpha,d,theta,offset\n0,0,0,q1,q2",
    "a,alpha,theta\n0,0,q1",
    "a,alpha,d,d,theta\n0,0,0,0,q1",
    "a,alpha,,,theta\n0,0,0,0,q1",
    "a_{i-1},alpha_i,d,theta\n0,0,0,q1",
    "a_i,alpha_{i-1},d,theta\n0,0,0,q1",
    "DH (standard)\na_{i-1},alpha_{i-1},d,theta\n0,0,0,q1",
    "DH (modified)\na_i,alpha_i,d,theta\n0,0,0,q1",
    "a [deg],alpha,d,theta\n0,0,0,q1",
    "a,alpha [m],d,theta\n0,0,0,q1",
    "a (in),alpha (deg),d (in),theta (deg)\n12,0,0,q1",
    "a,alpha [grad],d,theta\n12,0,0,q1",
    "x,y,z,w\n0,0,0,q1",
    "0,0,0\n1,1,1",
    r"\begin{tabular}{c} a & \alpha & d & \theta \\ 0",
    r"\begin{tabular}{c a & \alpha & d & \theta \\ 0 & 0 & 0 & q \\ \end{tabular}",
    'a,alpha,d,theta\n"0"1,0,0,q1',
    '<robot name="x"></robot>',
    "robot = DHRobot([RevoluteDH(d=0.67, alpha=pi/2)])",
    "L(1) = Link([0 0.4 0]);",
    "Link([0 0 1 0 2])",
    "Link([0 0 1 0])\nLink([0 0 1 0], 'modified')",
    "L(1) = Link([0 0 1 0]);\nL(1).offset = pi/2;",
)
"""Texts that are refused."""


def what_is_said_of_pasted_tables() -> Iterator[tuple[str, str]]:
    """Yield texts with each note on them, or why they are refused."""
    for text in NOTED:
        yield from ((text, note) for note in parse_table(text).notes)
    for text in REFUSED:
        try:
            parse_table(text)
        except InputError as refusal:
            yield text, str(refusal)
        else:
            raise AssertionError(f"{text!r} is read")
