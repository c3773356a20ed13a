"""The page Ellipsoid of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "ellipsoid",
    "Ellipsoid",
    "SPHERE",
    38,
    tab="velocity",
    about=(
        "S5.3-ellipsoid",
        "S5.3-singular-values",
        "S5.3-manipulability",
        "S5.3-2R-plots",
        "5.3",
        "5.4.1",
        "S5.1.4-singularity",
        "S5.1.4-2R",
        "S5.2.3-svd",
        "S5.4.1-force-ellipsoid",
        "velocity ellipsoid",
        "force ellipsoid",
        "manipulability over the distance",
        "condition number",
        "singular places",
        "manipulability",
        "Yoshikawa",
        "singular values",
        "isotropy",
        "force ellipse",
    ),
    exports=(Export("csv", "Manipulability as CSV", ("ellipsoid", "curves", "table")),),
)
