"""The page Calibration of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "calibration",
    "Calibration of a sensor",
    "ADJUSTMENTS",
    60,
    tab="absolute_encoder",
    page="Calibration",
    about=(
        "S2.3-measurement",
        "2.3",
        "calibration",
        "characteristic curve",
        "linearity error",
        "offset error",
        "gain error",
        "resolution error",
        "hysteresis",
        "least squares",
        "polynomial fit",
        "residuals",
        "drift",
        "stability",
        "percent of full scale",
    ),
    exports=(Export("csv", "Errors of a sensor before and after calibration as CSV", ("residuals", "table")),),
)
