"""The page Statics of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "statics",
    "Statics",
    "WEIGHT",
    39,
    tab="velocity",
    about=(
        "5.4",
        "S5.4-statics",
        "S5.4-virtual-work",
        "S5.4-duality",
        "statics",
        "wrench",
        "joint torques",
        "virtual work",
        "transpose of the Jacobian",
        "force without torque",
        "force",
        "payload",
        "torque",
        "load",
        "weight",
    ),
)
