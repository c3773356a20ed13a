"""The page View of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "picture",
    "View",
    "EYE",
    60,
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
