"""The page Torque of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "torque",
    "Torque of coils",
    "MAGNET",
    51,
    tab="drive",
    page="Torque",
    about=(
        "S2.1-lorentz",
        "S2.1-torque-ripple",
        "2.1",
        "(2.2-2.3)",
        "Lorentz force",
        "commutator",
        "brushes",
        "slip ring",
        "coil",
        "magnet",
        "torque ripple",
        "torque of a motor",
        "rotor",
    ),
    exports=(Export("csv", "Torque over the angle as CSV", ("ripple", "curves", "table")),),
)
