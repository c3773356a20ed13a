"""The page Skew & dyads of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "skew",
    "Skew & dyads",
    "GRID_4X4",
    35,
    tab="body",
    page="Skew",
    about=(
        "S3.2.1-skew",
        "S3.2.1-dyads",
        "3.2",
        "definition 3",
        "skew-symmetric matrix",
        "symmetric and skew part",
        "quadratic form",
        "cross product as a matrix",
        "outer product",
        "dyads",
        "dyadic expansion",
    ),
)
