"""The page DC motor of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "motor",
    "DC motor",
    "CIRCUIT_MOTOR",
    52,
    tab="drive",
    about=(
        "S2.1.1-dc-motor",
        "S2.1.1-laplace",
        "S2.1.1-kt-kv",
        "2.1.1",
        "(2.4-2.28)",
        "DC motor",
        "electric motor",
        "back-EMF",
        "armature",
        "torque constant",
        "speed constant",
        "V/krpm",
        "rpm/V",
        "inductance",
        "state space",
        "block diagram",
        "transfer function of a motor",
        "poles",
        "time constant",
        "step response of a motor",
        "stall",
        "generator",
        "power balance",
    ),
    exports=(Export("csv", "Run of the DC motor as CSV", ("current", "speed", "curves", "table")),),
)
