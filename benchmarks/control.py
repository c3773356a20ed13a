"""Kinematic control: a redundant arm under a control law for some seconds."""

from collections.abc import Callable, Iterator

import numpy as np

from armlab.content.robots import catalogue
from armlab.kin.control import LineReference, Settings, rate_inverse, simulate
from armlab.kin.control.scaled_task import ScaledTask
from rounds import header, medians, row, sized

TITLE = "Kinematic control: 7R arm, Runge-Kutta 4, 6 s at 1 kHz, one core"
ROBOT = "iiwa7"
VELOCITY = (0.02, 0.02, -0.02)
DURATION = sized(6.0, 0.02)


def measure() -> Iterator[str]:
    yield from header()
    for law, inverse, null in (
        ("open_loop", "pinv", "none"),
        ("cartesian_tracking", "pinv", "none"),
        ("cartesian_tracking", "dls_variable", "none"),
        ("cartesian_tracking", "pinv", "manipulability"),
        ("joint_tracking", "pinv", "none"),
    ):
        name = f"{law}, {inverse}{f', self-motion: {null}' if null != 'none' else ''}"
        yield row(name, medians({"Armlab": line(law, inverse, null)}, rounds=3), "ms", 1e3, 0)
    yield row("one step of an inverse, pinv", medians({"Armlab": step("pinv")}, rounds=9), "µs", 1e6, 1)


def line(law: str, inverse: str, null: str) -> Callable[[], object]:
    """Return the run of a line from home."""
    robot = catalogue()[ROBOT]
    home = np.asarray(robot.home, dtype=float)
    reference = LineReference(robot.arm.fk(home), VELOCITY, DURATION)
    settings = Settings(inverse=inverse, null=null)
    return lambda: simulate(robot.arm, law, reference, home, settings)


def step(key: str) -> Callable[[], object]:
    """Return one call of an inverse with a task Jacobian of the arm."""
    robot = catalogue()[ROBOT]
    task, q = ScaledTask(robot.arm), np.asarray(robot.home, dtype=float)
    J, v, method = task.scaled(task.jacobian(q)), np.full(task.m, 0.1), rate_inverse(key)
    options = method.options()
    return lambda: method.speeds(J, v, options)
