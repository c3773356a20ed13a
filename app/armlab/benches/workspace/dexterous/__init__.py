"""The page Dexterous of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "dexterous",
    "Dexterous",
    "COMPASS",
    38,
    tab="workspace",
    about=(
        "S4.2-ws2",
        "S4.2-ws-2R",
        "S4.3.1-ws-3R",
        "S4.3.1-ik-cases",
        "4.2",
        "4.3.1",
        "(4.20-4.21)",
        "(4.39-4.43)",
        "figure 4.9",
        "dexterous workspace",
        "secondary workspace",
        "WS2",
        "orientation",
        "approach direction",
        "number of solutions",
        "reachable orientations",
        "dexterity",
    ),
)
