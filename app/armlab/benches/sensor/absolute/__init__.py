"""The page Absolute encoder of the lab, the first one of the tab Sensors."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "absolute_encoder",
    "Sensors",
    "RULER_MEASURE",
    56,
    page="Absolute encoder",
    about=(
        "S2.3.1-abs-encoder",
        "2.3.1",
        "(2.40)",
        "sensors",
        "absolute encoder",
        "gray code",
        "binary code",
        "code disk",
        "tracks",
        "resolution of an encoder",
        "optical encoder",
        "glitch",
        "misaligned sensor",
    ),
    exports=(Export("csv", "Readings of the absolute encoder over a turn as CSV", ("gray code", "curves", "table")),),
)
