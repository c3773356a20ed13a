"""Settings of one run of kinematic control: the reference, the start, the law and the plant."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, wrong
from armlab.kin.control.control_law import ControlLaw, control_law
from armlab.kin.control.encoder import SHAFTS
from armlab.kin.control.null_term import TITLES as NULL_TITLES
from armlab.kin.control.plant import MOST_WRONG
from armlab.kin.control.rate_inverse import RateInverse, rate_inverse
from armlab.kin.control.run import INTEGRATORS, clock
from armlab.kin.control.saturation import SATURATIONS
from armlab.kin.field import Field
from armlab.registry import known_name
from armlab.session.parts.target import FARTHEST
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Json

REFERENCES = {
    "line": "line, constant velocity",
    "circle": "circle, constant speed",
    "planned": "the planned motion",
    "target": "the target, at rest",
}

MOST_RUNS = 4
MOST_PUSHES = 8
LONGEST_NAME = 60
MOST_STEPS = 60_000
"""Largest number of steps of a run: a minute at 1 kHz, some 10 s of work."""

Value = float | int | str | bool | tuple[float, ...] | None
Pairs = tuple[tuple[str, Value], ...]
Push = tuple[float, float, float, float]
"""A push: its time in seconds, and its vector in metres in the world."""

MOVING = ("line", "circle")

WAY = (
    Field("speed", "v", "speed of the tool", "number", 0.2, 0.0, 20.0, unit="q/s", only=(("reference", MOVING),)),
    Field("azimuth", "φ", "direction in the plane, from x", "number", 0.0, unit="rad", only=(("reference", MOVING),)),
    Field("elevation", "ψ", "direction above the plane", "number", 0.0, unit="rad", only=(("reference", ("line",)),)),
    Field("radius", "r", "radius", "number", 0.1, 0.0, 100.0, True, "q", only=(("reference", ("circle",)),)),
    Field("duration", "T", "duration", "number", 4.0, 0.05, 60.0, unit="s", only=(("reference", (*MOVING, "target")),)),
)
"""Options of the reference. A line goes along the direction, a circle starts along it, about an axis parallel to z."""

CLOCK = (
    Field("step", "", "time step h", "number", 1e-3, 1e-4, 0.1, unit="s"),
    Field("integrator", "", "integration", "choice", "rk4", choices=tuple(INTEGRATORS.items())),
    Field("sampling", "", "sampling time, 0: none", "number", 0.0, 0.0, 1.0, unit="s"),
)

MOTORS = (
    Field("saturation", "", "limits on joint speeds", "choice", "none", choices=tuple(SATURATIONS.items())),
    Field(
        "limit",
        "q̇_max",
        "of revolute joints; if omitted, those of the arm",
        "number",
        None,
        1e-4,
        1e4,
        unit="q/s",
        only=(("saturation", ("clip", "scale")),),
    ),
    Field(
        "slide_limit",
        "ḋ_max",
        "of prismatic joints; if omitted, those of the arm",
        "number",
        None,
        1e-4,
        1e4,
        unit="q/s",
        only=(("saturation", ("clip", "scale")),),
    ),
)

KNOWLEDGE = (
    Field("counts", "", "encoder counts a turn, 0: exact", "whole", 0, 0, 1e8),
    Field("shaft", "", "encoder on the", "choice", "motor", choices=tuple(SHAFTS.items())),
    Field("ratio", "", "gear ratio", "number", 100.0, 1e-2, 1e4, only=(("shaft", ("motor",)),)),
    Field("wrong", "", "links longer than the controller assumes", "number", 0.0, -MOST_WRONG, MOST_WRONG, unit="q"),
    Field("link", "", "which link, 0: all", "whole", 0, 0),
)

NULL = (
    Field("null", "", "self-motion", "choice", "none", choices=tuple(NULL_TITLES.items())),
    Field(
        "null_gain",
        "k",
        "gain of the self-motion",
        "number",
        1.0,
        -1e3,
        1e3,
        unit="1/s",
        only=(("null", ("middle", "manipulability")),),
    ),
)

GROUPS = (WAY, CLOCK, MOTORS, KNOWLEDGE, NULL)

FIELDS = {each.key: each for group in GROUPS for each in group}


@dataclass(frozen=True)
class Setup:
    """Settings of one run; `with_value` makes changed ones.

    Attributes
    ----------
    start : tuple of float
        Joint values, rad or m, at which the reference begins; of the planned motion of no account.
    offset : tuple of float
        The arm stands so far from there at time 0: of a tracked reference q − q_d, the initial error with the other
        sign.
    reference : str
        Key of `REFERENCES`.
    law, inverse : str
    law_options, inverse_options : tuple of (str, value)
        Those that are not at their defaults.
    pushes : tuple of Push
    colour : int
        Which of `MOST_RUNS` colours it is drawn in; no other run has it.
    name : str
        Its name; empty for a name made of law and inverse.
    speed, azimuth, ... : float
        See `FIELDS`; metres, radians, seconds.
    """

    start: tuple[float, ...]
    offset: tuple[float, ...]
    reference: str = "line"
    law: str = "cartesian_tracking"
    inverse: str = "pinv"
    law_options: Pairs = ()
    inverse_options: Pairs = ()
    pushes: tuple[Push, ...] = ()
    colour: int = 0
    name: str = ""
    speed: float = 0.2
    azimuth: float = 0.0
    elevation: float = 0.0
    radius: float = 0.1
    duration: float = 4.0
    step: float = 1e-3
    integrator: str = "rk4"
    sampling: float = 0.0
    saturation: str = "none"
    limit: float | None = None
    slide_limit: float | None = None
    counts: int = 0
    shaft: str = "motor"
    ratio: float = 100.0
    wrong: float = 0.0
    link: int = 0
    null: str = "none"
    null_gain: float = 1.0

    @property
    def kind(self) -> ControlLaw:
        """The control law."""
        return control_law(self.law)

    @property
    def method(self) -> RateInverse:
        """The inverse of the differential kinematics."""
        return rate_inverse(self.inverse)

    @property
    def given(self) -> dict[str, Any]:
        """All values by key, as a form takes them."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    @property
    def title(self) -> str:
        """The name, or if it is empty law and inverse."""
        if self.name:
            return self.name
        law = self.kind.title.split(":")[0]
        return f"{law.split(',')[0]}: {self.method.title}" if self.kind.inverts else law

    @property
    def moves(self) -> bool:
        """Whether the reference moves; a planned motion always counts as one that does."""
        return self.reference == "planned" or (self.reference in MOVING and self.speed > 0.0)

    def held(self, made: float | None = None) -> tuple[float, float]:
        """Return the step of the run, and for how long a sampled command is held, seconds; 0 if nothing is sampled.

        ``made`` is the step of its result, if there is one: how long a planned motion lasts is known only then.
        """
        step = self.step if made is None else made
        _, step, every = clock(step if self.reference == "planned" else self.duration, step, self.sampling)
        return step, every * step

    def seen(self, group: tuple[Field, ...]) -> tuple[Field, ...]:
        """Return the options of a group that can be used, which may depend on values of other groups."""
        given = self.given
        return tuple(replace(each, only=()) for each in group if each.usable(given))

    def with_value(self, key: str, value: Any) -> Self:
        """Return the settings with one value of `FIELDS` changed; None restores its default.

        Raises
        ------
        InputError
            There is none such, or it is out of range.
        """
        field = FIELDS[known_name("value of a run", key, FIELDS)]
        if key == "wrong" and isinstance(value, float) and not abs(value) <= MOST_WRONG:
            raise InputError(f"{field.title}: expected at most {100.0 * MOST_WRONG:g} % more or less")
        checked = field.default if value is None else field.checked(value)
        return replace(self, **{key: checked})._not_too_long()

    def with_reference(self, key: str) -> Self:
        """Return the settings with another reference; `InputError` if it has too many steps."""
        return replace(self, reference=checked_reference(key))._not_too_long()

    def _not_too_long(self) -> Self:
        # How long a planned motion lasts is known when it is run.
        if self.reference != "planned":
            refuse_steps(self.duration, self.step)
        return self

    def with_law(self, key: str) -> Self:
        """Return the settings with another law, at its defaults."""
        return replace(self, law=control_law(key).key, law_options=())

    def with_inverse(self, key: str) -> Self:
        """Return the settings with another inverse, at its defaults."""
        return replace(self, inverse=rate_inverse(key).key, inverse_options=())

    def with_option(self, of: str, key: str, value: Any) -> Self:
        """Return the settings with an option of their ``"law"`` or ``"inverse"`` changed; None restores its default."""
        owner: ControlLaw | RateInverse = self.kind if of == "law" else self.method
        given = dict(self.law_options if of == "law" else self.inverse_options)
        if value is None:
            given.pop(key, None)
        else:
            given[key] = value
        checked = options_of(owner, given)
        return replace(self, **{f"{of}_options": checked})  # type: ignore[arg-type]

    def to_json(self) -> Json:
        """Write the settings."""
        return {each.name: _written(getattr(self, each.name)) for each in fields(self) if each.name != "colour"} | {
            "colour": self.colour
        }


def _written(value: Any) -> Json:
    return [_written(each) for each in value] if isinstance(value, tuple) else value


def options_of(owner: ControlLaw | RateInverse, given: Mapping[str, Any]) -> Pairs:
    """Return checked options in the form in which they are kept; `InputError` if one is unknown or wrong."""
    checked = owner.options(given)
    return tuple((key, _kept(checked[key])) for key in checked if key in given)


def _kept(value: Any) -> Value:
    return tuple(value.tolist()) if isinstance(value, np.ndarray) else value


def refuse_steps(duration: float, step: float) -> None:
    """Raise `InputError` if a run of a duration, seconds, has too many steps."""
    if duration / step > MOST_STEPS * (1.0 + 1e-9):
        raise InputError(f"T / h: expected at most {MOST_STEPS} steps, got {duration:g} s / {step:g} s")


def setup_of(robot: Robot, start: ArrayLike | None = None, colour: int = 0, **values: Any) -> Setup:
    """Return checked settings for an arm.

    Parameters
    ----------
    robot : Robot
    start : array_like, shape (n,), optional
        The home pose when left out.
    colour : int
    **values
        Any of the attributes; law_options and inverse_options as mappings.

    Raises
    ------
    InputError
        One of them is unknown, out of range, or not for this arm.
    """
    arm = robot.arm
    setup = Setup(
        joint_values(arm, robot.home if start is None else start, "start"),
        joint_values(arm, values.pop("offset", np.zeros(arm.n)), "initial offset"),
    )
    if type(colour) is not int or not 0 <= colour < MOST_RUNS:
        raise InputError(f"colour: expected 0 to {MOST_RUNS - 1}, got {colour!r}")
    setup = replace(
        setup,
        colour=colour,
        name=checked_name(values.pop("name", "")),
        reference=checked_reference(values.pop("reference", "line")),
        pushes=checked_pushes(values.pop("pushes", ())),
    )
    setup = setup.with_law(values.pop("law", setup.law)).with_inverse(values.pop("inverse", setup.inverse))
    law = options_of(setup.kind, values.pop("law_options", {}))
    setup = replace(setup, law_options=law, inverse_options=options_of(setup.method, values.pop("inverse_options", {})))
    # The step first: whether a duration is too long depends on it.
    for key in sorted(values, key=lambda key: key != "step"):
        setup = setup.with_value(key, values[key])
    return setup


def setup_from(robot: Robot, data: Json) -> Setup:
    """Return settings read back; raises if they cannot be used with this arm."""
    values = {**data, "law_options": dict(data["law_options"]), "inverse_options": dict(data["inverse_options"])}
    return setup_of(robot, values.pop("start"), values.pop("colour"), **values)


def joint_values(arm: Arm, q: ArrayLike, where: str) -> tuple[float, ...]:
    """Return joint values; `InputError` unless they are one number for each joint, inside its possible values."""
    values = finite_floats(q, where, (arm.n,), f"{arm.n} finite joint values")
    if np.any(np.abs(values) > np.where(arm.revolute, MOST_TURNED, FARTHEST * arm.length_scale)):
        raise InputError(f"{where}: a joint cannot take this value; expected at most ten turns")
    return tuple(values.tolist())


def checked_reference(key: str) -> str:
    """Return the key of a reference; `UnknownName` if there is none."""
    return known_name("reference", key, REFERENCES)


def checked_name(name: str) -> str:
    """Return the name of a run without spaces around it, cut if it is too long; `InputError` if it is no text."""
    if not isinstance(name, str):
        raise wrong("name of a run", "text", name)
    return name.strip()[:LONGEST_NAME]


def checked_pushes(pushes: Any) -> tuple[Push, ...]:
    """Return pushes; `InputError` if there are too many, or for invalid numbers."""
    found = tuple((float(t), float(x), float(y), float(z)) for t, x, y, z in pushes)
    if len(found) > MOST_PUSHES:
        raise InputError(f"pushes: expected at most {MOST_PUSHES} in a run, got {len(found)}")
    if not all(map(math.isfinite, (number for push in found for number in push))) or any(t < 0.0 for t, *_ in found):
        raise InputError("pushes: expected finite numbers, and times from 0 on")
    return found


def free_colour(runs: tuple[Setup, ...]) -> int:
    """Return the first colour that no run has; `InputError` if no colour is left."""
    taken = {run.colour for run in runs}
    for colour in range(MOST_RUNS):
        if colour not in taken:
            return colour
    raise InputError(f"at most {MOST_RUNS} runs can be told apart in one picture: remove one first")
