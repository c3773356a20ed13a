"""The page Display of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "picture",
    "View",
    "EYE",
    60,
    page="Display",
    about=(
        "camera",
        "theme",
        "labels",
        "units",
        "overlays",
        "settings",
        "preferences",
        "notation",
        "start fresh",
    ),
    always=True,
)
