"""The page Integral of ω of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "integral",
    "Integral of ω",
    "MATH_INTEGRAL",
    37,
    tab="body",
    page="Integral",
    about=(
        "S5.1-omega-integral",
        "5.1",
        "5.19-5.21",
        "integral of the angular velocity",
        "omega is not exact",
        "time laws of omega",
        "coning",
        "orientation from gyroscopes",
    ),
    exports=(Export("csv", "ω over time as CSV", ("angular velocity", "curves", "table")),),
)
