"""The page Encoder velocity of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "encoder_speed",
    "Encoder velocity",
    "BRAND_SPEEDTEST",
    58,
    tab="absolute_encoder",
    about=(
        "S2.3.1-encoder-speed",
        "2.3.1",
        "(2.42-2.43)",
        "speed from an encoder",
        "angular velocity from counts",
        "counts per window",
        "time between edges",
        "M method",
        "T method",
        "quantisation",
        "delay of a measurement",
        "tachometer",
    ),
    exports=(Export("csv", "Measured speeds of a run as CSV", ("encoder", "curves", "table")),),
)
