"""The page Reachable of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "workspace",
    "Workspace",
    "CHART_DOTS_3",
    36,
    page="Reachable",
    about=(
        "S4.2-ws1",
        "4.2",
        "4.17",
        "4.18",
        "4.19",
        "workspace",
        "reachable workspace",
        "primary workspace",
        "reach",
        "manipulability",
    ),
)
