"""The page Incremental encoder of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "incremental_encoder",
    "Incremental encoder",
    "WAVE_SQUARE",
    57,
    tab="absolute_encoder",
    page="Incremental",
    about=(
        "S2.3.1-inc-encoder",
        "S2.3.2-quadrature",
        "2.3.1",
        "2.3.2",
        "(2.41)",
        "(2.44-2.45)",
        "incremental encoder",
        "quadrature",
        "pulses per revolution",
        "PPR",
        "angular resolution",
        "electrical degree",
        "index track",
        "counter",
        "direction of rotation",
        "miscount",
        "jitter",
    ),
    exports=(Export("csv", "Angle and count over time as CSV", ("quadrature", "curves", "table")),),
)
