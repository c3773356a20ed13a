"""The terms of a first course in robotics as the lab uses them."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.kin.conditioning import NEAR, POOR


@dataclass(frozen=True)
class Term:
    """One term.

    Attributes
    ----------
    name : str
    says : str
        Its definition, in one or two sentences.
    symbol : str
        In LaTeX; empty for none.
    page : str
        Key of the page where it is seen.
    others : tuple of str
        Other names of the same, and names of what is explained with it.
    """

    name: str
    says: str
    symbol: str
    page: str
    others: tuple[str, ...] = ()


TERMS: tuple[Term, ...] = (
    Term(
        "Back-EMF",
        "The voltage that a turning motor makes against the one that drives it: k times its speed. It is a loop inside "
        "the motor and limits its speed.",
        r"v_{emf}=k\,\omega",
        "motor",
        ("back electromotive force", "speed constant"),
    ),
    Term(
        "Backlash",
        "The motion that a joint can make while its motor stands still, because teeth or threads have room between "
        "them. An encoder on the motor does not see it.",
        "",
        "joint_drive",
        ("play",),
    ),
    Term(
        "Closed form",
        "A formula that gives all solutions of the inverse kinematics in finitely many steps. An arm has one if, for "
        "example, three neighbouring axes meet in one point or are parallel.",
        "",
        "by_hand",
        ("analytic solution",),
    ),
    Term(
        "Commutator",
        "A divided ring on the rotor of a motor that reverses the current of a coil at each half turn, so that its "
        "torque keeps one sign. A brushless motor switches its currents electronically instead.",
        "",
        "torque",
        ("brushes", "brushless motor"),
    ),
    Term(
        "Condition number",
        "The largest singular value of the Jacobian over the smallest; the inverse condition is its reciprocal. Metres "
        "and radians are first made comparable, or only rows of one unit are taken. A configuration is called poorly "
        f"conditioned where the inverse condition is below {POOR:g}, and near a singularity where it is below "
        f"{NEAR:g}.",
        r"\kappa=\sigma_{max}/\sigma_{min}",
        "microscope",
        ("inverse condition", "well conditioned", "poorly conditioned"),
    ),
    Term("Configuration", "The values of all joint variables of an arm.", "q", "joints", ("joint values", "posture")),
    Term(
        "Damped least squares",
        "An inverse of the differential kinematics that also keeps joint speeds small. Near a singularity it "
        "trades them "
        "for an error of the tool.",
        r"J^T(JJ^T+\lambda I)^{-1}",
        "microscope",
        ("damping factor",),
    ),
    Term(
        "Degree of freedom",
        "An independent way of moving. An arm with n joints has n; a rigid body in space has six.",
        "n",
        "joints",
    ),
    Term(
        "Denavit–Hartenberg parameters",
        "Four numbers that place the frame of a link relative to the one before: link length, link twist, link "
        "offset and "
        "joint angle. In the standard and the modified convention they are applied in different orders.",
        r"a,\,\alpha,\,d,\,\theta",
        "table",
        ("DH parameters", "link length", "link twist", "link offset", "joint angle"),
    ),
    Term(
        "Efficiency",
        "Useful power over the power that is supplied. Those of converters in a chain multiply. A motor that holds a "
        "load still has the efficiency zero.",
        r"\eta=P_u/P_c",
        "drive",
        ("losses",),
    ),
    Term(
        "End effector",
        "What is mounted on the last link to do the work, such as a gripper. The lab calls it the tool.",
        "",
        "table",
        ("hand",),
    ),
    Term(
        "Forward kinematics",
        "The pose of the tool as a function of the configuration; also called direct kinematics.",
        r"T(q)",
        "formulas",
        ("direct kinematics",),
    ),
    Term(
        "Frame",
        "An origin with three perpendicular axes, fixed to a body. Frame {i} moves with link i, frame {0} and the "
        "world "
        "frame {w} are at rest, frame {E} is that of the tool.",
        r"\{i\}",
        "pose",
        ("world frame", "base frame"),
    ),
    Term(
        "Harmonic drive",
        "A gear whose flexible ring, bent by a turning wave generator, loses two of its teeth in each turn: a large "
        "ratio in one stage, with hardly any backlash. Also called strain wave gear.",
        "",
        "harmonic",
        ("flexspline", "wave generator", "circular spline"),
    ),
    Term(
        "Homogeneous transform",
        "The pose of one frame in another as a 4 × 4 matrix, of rotation R and position p above a row 0 0 0 1. It also "
        "leads coordinates of points from the one frame to the other, and products of transforms are chains of frames.",
        "{}^{A}T_B",
        "frame_chain",
        ("transformation matrix", "change of coordinates"),
    ),
    Term(
        "Inverse kinematics",
        "The configurations in which the tool has a given pose. There may be none, several, or infinitely many.",
        "",
        "target",
    ),
    Term(
        "Jacobian",
        "The matrix that maps joint speeds to the velocity of the tool. The geometric Jacobian gives v and ω, the "
        "analytic "
        "one the rates of chosen coordinates.",
        r"J(q)",
        "velocity",
        ("differential kinematics", "geometric Jacobian", "analytic Jacobian"),
    ),
    Term("Joint space", "The set of all configurations; the task space is the set of all poses.", "", "pictures"),
    Term(
        "Joint variable",
        "What changes when a joint moves: the angle of a revolute joint (R), the displacement of a prismatic joint "
        "(P).",
        r"q_i",
        "joints",
        ("revolute joint", "prismatic joint"),
    ),
    Term(
        "Manipulability",
        "The product of the singular values of the Jacobian. It is zero in singular configurations, but how small "
        "it is "
        "depends on the units.",
        r"w=\sqrt{\det(JJ^T)}",
        "ellipsoid",
        ("velocity ellipsoid", "force ellipsoid"),
    ),
    Term(
        "Null space",
        "The joint speeds that leave the tool at rest.",
        r"\mathcal{N}(J)",
        "solve",
        ("kernel",),
    ),
    Term("Path", "A curve without time, in joint space or of the tool.", r"q(s)", "motion"),
    Term(
        "Pose",
        "Position and orientation of one frame in another. Without further words it is that of the tool in the world. "
        "A named pose of an arm, such as home, is a configuration with a name.",
        r"T",
        "pose",
        ("position", "orientation", "homogeneous transformation", "named pose"),
    ),
    Term(
        "Pseudo-inverse",
        "Of all joint speeds that bring the tool closest to the wanted velocity it gives the shortest.",
        r"J^\#",
        "solve",
    ),
    Term(
        "Reduction ratio",
        "The turns of the motor for one turn of the load. The speed is divided by it, and without losses the torque is "
        "multiplied by it; a negative ratio turns the sense round.",
        "n",
        "gears",
        ("gear ratio", "transmission ratio"),
    ),
    Term(
        "Redundant arm",
        "An arm with more joints than its task has components. It can move while its tool stays: a self-motion.",
        r"n>m",
        "solutions",
        ("redundancy", "self-motion"),
    ),
    Term(
        "Screw motion",
        "A turn about a line in space together with a slide along it. A body can be brought from any pose to any "
        "other by one such motion; the slide for each turn is its pitch.",
        "",
        "screw",
        ("screw axis", "pitch of a screw", "twist"),
    ),
    Term(
        "Servomotor",
        "A motor with a sensor of its angle and a controller that compares the angle with the wanted one.",
        "",
        "drive",
        ("actuator",),
    ),
    Term(
        "Singular configuration",
        "A configuration in which the rank of the Jacobian drops: in some direction no joint speed moves the tool, "
        "and in "
        "some direction a force needs no torque. Also called a singularity.",
        r"\mathrm{rank}\,J<\min(m,n)",
        "microscope",
        ("singularity",),
    ),
    Term(
        "Singular value",
        "A half axis of the ellipsoid into which the Jacobian maps the unit sphere of joint speeds.",
        r"\sigma_i",
        "ellipsoid",
    ),
    Term(
        "Solution",
        "A configuration that reaches the target. Solutions that differ by a mirror choice, such as elbow up or down, "
        "belong to different branches.",
        "",
        "solutions",
        ("branch",),
    ),
    Term(
        "Spherical wrist",
        "Three revolute joints whose axes meet in one point, the wrist centre. It turns the tool without moving that "
        "point.",
        "",
        "by_hand",
        ("wrist centre",),
    ),
    Term(
        "Task",
        "The components of the pose that an arm controls, such as the position and an angle.",
        "m",
        "target",
        ("task space",),
    ),
    Term(
        "Timing law",
        "How the path parameter grows with time, such as a trapezoidal speed profile.",
        r"s(t)",
        "laws",
        ("speed profile", "time scaling"),
    ),
    Term(
        "Tool",
        "The end effector, drawn as a gripper; its frame is {E}, and the origin of that frame is the tool point, "
        "between "
        "the finger tips.",
        r"\{E\}",
        "table",
        ("tool frame", "tool point", "TCP", "tool centre point"),
    ),
    Term(
        "Torque constant",
        "Torque of a motor for each ampere. In SI it is the same number as its voltage for each radian per second.",
        r"k_t=k_v=k",
        "motor",
        ("voltage constant",),
    ),
    Term(
        "Torque of a joint",
        "What a motor exerts about the axis of a revolute joint; of a prismatic joint it is a force along its axis.",
        r"\tau=J^TF",
        "statics",
    ),
    Term(
        "Torque ripple",
        "The largest less the least torque of a motor over a turn, divided by the mean. It falls with the square of "
        "the number of coils.",
        "",
        "torque",
    ),
    Term(
        "Trajectory",
        "A path with its timing: the configuration or the pose at each time.",
        r"q(t)",
        "motion",
        ("motion",),
    ),
    Term(
        "Velocity of the tool",
        "The velocity of the tool point and the angular velocity of the tool; together also called its twist.",
        r"v,\,\omega",
        "velocity",
        ("twist", "angular velocity"),
    ),
    Term("Waypoint", "A configuration or pose through or near which a motion passes.", "", "motion", ("via point",)),
    Term(
        "Workspace",
        "The reachable workspace holds all points that the tool point reaches, the dexterous workspace those that it "
        "reaches in every orientation.",
        r"WS_1,\,WS_2",
        "workspace",
        ("reachable workspace", "dexterous workspace"),
    ),
    Term(
        "Wrench",
        "A force and a moment, here those that the tool exerts on its environment.",
        r"F",
        "statics",
        ("force", "moment"),
    ),
)
"""All terms in alphabetical order."""
