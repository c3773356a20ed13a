"""The page Compare designs of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "what_if",
    "Compare designs",
    "ARROWS_DIFF",
    38,
    tab="workspace",
    about=(
        "S4.2-ws1",
        "4.2",
        "what if",
        "link length",
        "joint limits",
        "design",
        "compare workspaces",
        "volume",
        "parameter",
        "longer links",
        "compare arms",
    ),
)
