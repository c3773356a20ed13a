"""Facts of gears that lessons can check."""

from __future__ import annotations

from armlab.benches.drive.gears.state import SHOWN, Gears
from armlab.kin.drive.best_ratio import measured_slope, motor_torque, printed_slope, reflected, slope
from armlab.kin.drive.train import LAYOUTS
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _of(state: State) -> Gears:
    return state[Gears]


def _torque(state: State) -> float:
    part = _of(state)
    return float(motor_torque(part.load, part.ratio))


FACTS = Facts(
    __name__,
    (Gears,),
    {
        "teeth": Fact("the numbers of teeth", lambda s: _of(s).teeth, kind="numbers"),
        "wheels": Fact("the number of wheels", lambda s: len(_of(s).teeth), kind="count"),
        "layout": Fact("the arrangement of the wheels", lambda s: _of(s).layout, kind="text", names=LAYOUTS),
        "train_ratio": Fact("the ratio of the train, negative against the motor", lambda s: _of(s).train.ratio),
        "turns": Fact("the turns of each wheel for one of the first", lambda s: _of(s).train.turns, kind="numbers"),
        "module": Fact("the module of the first pair", lambda s: _of(s).train.modules(_of(s).distances)[0], "m"),
        "load_speed": Fact("the speed of the load", lambda s: _of(s).transfer.load_speed, "rad/s"),
        "torque_on_load": Fact("the torque on the load", lambda s: _of(s).transfer.load_torque, "N m"),
        "motor_power": Fact("the power of the motor", lambda s: _of(s).transfer.motor_power, "W"),
        "load_power": Fact("the power on the load", lambda s: _of(s).transfer.load_power, "W"),
        "lost": Fact("the power that is lost", lambda s: _of(s).transfer.lost, "W"),
        "efficiency": Fact("the efficiency of the train", lambda s: _of(s).whole_efficiency),
        "ratio": Fact("the ratio that is looked at", lambda s: _of(s).ratio),
        "motor_torque": Fact("the torque of the motor at that ratio", _torque, "N m"),
        "best_ratio": Fact("the best ratio", lambda s: _of(s).best.ratio),
        "least_torque": Fact("the torque of the motor at the best ratio", lambda s: _of(s).best.torque, "N m"),
        "slope_measured": Fact(
            "the derivative of the torque by the ratio, by differences",
            lambda s: measured_slope(_of(s).load, _of(s).ratio),
            "N m",
        ),
        "slope": Fact("that derivative by its formula", lambda s: slope(_of(s).load, _of(s).ratio), "N m"),
        "slope_with_plus": Fact(
            "the formula with a plus sign, which is wrong", lambda s: printed_slope(_of(s).load, _of(s).ratio), "N m"
        ),
        "load_torque": Fact("the constant torque of the load", lambda s: _of(s).load_torque, "N m"),
        "inertia_at_motor": Fact(
            "the whole inertia that the motor feels", lambda s: reflected(_of(s).load, _of(s).ratio)[0], "kg m²"
        ),
        "shown": Fact("what is shown of gears", lambda s: _of(s).shown, kind="text", names=SHOWN),
    },
)
