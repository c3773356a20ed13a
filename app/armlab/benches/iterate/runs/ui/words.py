"""The pages of iterations in words: small numbers, outcomes, task vectors, units of parameters."""

from __future__ import annotations

from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import vector_of
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import Parameter, TaskVector, task_vector
from armlab.kin.task import Task
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.format import capitalised, subscript
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import SIGNS
from armlab.ui.small_numbers import NO_BREAK, with_unit
from armlab.ui.symbols import with_indices
from armlab.ui.units import Units

GOING = ("most", "going", "limit", "jumped")
"""Statuses of runs that more steps, or other ones, might bring to the target."""

OWN, POSITION = "own", "position"
EULER = ("zyx", "zyz", "xyz")
"""Keys of task vectors besides one for each joint and each sequence of Euler angles."""


def errors(film: Film, i: int, units: Units) -> str:
    """Return the errors of an iterate with their units: position, orientation, and joints of the task vector."""
    vector = film.question.task or TaskVector(film.question.arm.task)
    said = []
    if vector.task.position:
        said.append(with_unit(float(film.position_error[i]), False, units))
    if vector.task.rotation != "none":
        said.append(with_unit(float(film.rotation_error[i]), True, units))
    for k, (joint, _) in enumerate(vector.joints):
        revolute = bool(film.question.arm.revolute[joint - 1])
        error = float(film.components[i, vector.task.m + k])
        said.append(f"{subscript('q', joint)}{NO_BREAK}{with_unit(abs(error), revolute, units)}")
    return ", ".join(said)


def kind_of(film: Film) -> str:
    """Return ``ok``, ``warn`` or ``no`` for an outcome."""
    return "ok" if film.success else "warn" if film.status in GOING else "no"


def outcome(film: Film, units: Units) -> Markup:
    """Return the end of a run, with a sign and a sentence."""
    kind = kind_of(film)
    said = capitalised(film.reason).rstrip(".") + "."
    if not film.success and film.status != "refused":
        said += f" Error at the end: {errors(film, film.last, units)}."
    return tag(f"p.{kind}", f"{SIGNS[kind]} {said}")


def sigma_unit(state: State) -> str:
    """Return the unit of singular values: ``"m"`` for the position of an arm with revolute joints, else no unit."""
    joints = state[Joints]
    turns = all(row.revolute for row, held in zip(joints.arm.rows, joints.locked, strict=True) if not held)
    return "m" if turns and set(vector_of(state).kinds(joints.arm)) == {"m"} else ""


def parameter_unit(parameter: Parameter, sigma_unit: str, freedom: int) -> str:
    """Return the unit of a parameter; that of singular values is metres or none."""
    if parameter.unit in ("1", "s"):
        return {"1": "", "s": "s"}[parameter.unit]
    if parameter.unit == "1/s":  # of a gain, which multiplies Jᵀe
        return "m⁻²s⁻¹" if sigma_unit == "m" else "1/s"
    if sigma_unit != "m":
        return ""
    powers = {2: "²", 3: "³"}
    return {"sigma": "m", "sigma²": "m²", "1/sigma²": "m⁻²"}.get(parameter.unit, f"m{powers.get(freedom, '')}")


def vector_text(vector: TaskVector) -> Markup:
    """Return the components of a task vector: (p_x, p_y, q_3)."""
    return joined("(", joined(map(with_indices, vector.names), between=", "), ")")


def _plain(vector: TaskVector) -> str:
    """Return the components without markup, which an option of a list cannot have: px, py, pz."""
    return ", ".join(vector.names).replace("_", "")


def choices(arm: Arm) -> dict[str, str]:
    """Return the task vectors that can be chosen for an arm: key to text."""
    own = arm.task
    found = {OWN: f"The arm's own: {_plain(TaskVector(own))}"}
    if not own.position:
        return found
    place = Task(own.position, "none")
    if own.rotation != "none":
        found[POSITION] = f"Position only: {_plain(TaskVector(place))}"
    if arm.n == place.m + 1:
        for joint in range(1, arm.n + 1):
            found[f"q{joint}"] = f"Position and {subscript('q', joint)}"
    if own.rotation == "full":
        for sequence in EULER:
            found[sequence] = f"Position and Euler angles {sequence.upper()}"
    return found


def chosen(arm: Arm, vector: TaskVector | None) -> str:
    """Return the key of a task vector among the choices; one that is not among them has the key of the arm's own."""
    if vector is None:
        return OWN
    if vector.euler:
        return vector.euler
    if vector.joints:
        return f"q{vector.joints[0][0]}"
    return POSITION if vector.task.key != arm.task.key else OWN


def made(arm: Arm, key: str, wanted: float) -> TaskVector | None:
    """Return the task vector of a key; ``wanted`` is the value of a joint in it, rad or m."""
    if key == OWN:
        return None
    if key in EULER:
        return task_vector(arm, euler=key)
    place = Task(arm.task.position, "none").key
    if key == POSITION:
        return task_vector(arm, place)
    return task_vector(arm, place, joints={int(key[1:]): wanted})
