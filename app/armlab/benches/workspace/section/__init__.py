"""The page Section of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "section",
    "Section",
    "CUT",
    37,
    tab="workspace",
    about=(
        "S4.2-side-view",
        "S4.2-ws1",
        "4.2",
        "workspace",
        "side view",
        "data sheet",
        "section of the workspace",
        "volume of the workspace",
        "boundary of the workspace",
        "reach",
        "slice",
        "area",
        "envelope",
    ),
)
