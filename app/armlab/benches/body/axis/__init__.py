"""The page Axis & angle of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "axis",
    "Axis & angle",
    "ROTATE_360",
    34,
    tab="body",
    about=(
        "S3.2-axis-angle",
        "S3.2.1-dyads",
        "S3.2.1-skew",
        "S3.2.1-rodrigues",
        "S3.2.1-eigen",
        "S3.2.2-inverse",
        "3.2",
        "rodrigues",
        "eigenvalues on the unit circle",
        "arccos and atan2",
        "lost digits",
        "rotation in three steps",
    ),
    exports=(Export("csv", "Errors of arccos and atan2 as CSV", ("lost digits", "curves", "table")),),
)
