"""The page Power of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "drive",
    "Drives",
    "ENGINE",
    50,
    page="Power",
    about=(
        "S2.0-system",
        "S2.0-power",
        "S2.1-motor-pros-cons",
        "S2.1-brushed-brushless",
        "2",
        "2.1",
        "actuator",
        "actuators",
        "power chain",
        "efficiency",
        "losses",
        "Sankey diagram",
        "robot as a system",
        "functional units",
        "holding torque",
        "brake",
        "electric, pneumatic, hydraulic",
        "hydraulic",
        "pneumatic",
        "brushed and brushless",
        "brushless",
        "servomotor",
    ),
)
