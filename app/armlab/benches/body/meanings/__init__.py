"""The page Meanings of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "meanings",
    "Three meanings",
    "AXIS_X",
    29,
    tab="body",
    page="Meanings",
    about=(
        "S3.1-three-meanings",
        "S3.1-rotation-matrix",
        "S3.1-chain",
        "S3.1-elementary",
        "3.1",
        "change of coordinates",
        "direction cosines",
        "rotate a vector",
        "operator",
    ),
)
