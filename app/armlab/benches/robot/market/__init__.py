"""The page Market of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "market",
    "Market",
    "TRENDING_UP",
    16,
    tab="robot",
    about=(
        "S1.8-ifr",
        "S1.8-cagr",
        "1.8",
        "market of robots",
        "number of robots in the world",
        "IFR",
        "growth rate",
        "compound growth",
        "doubling time",
        "statistics",
    ),
)
