"""The page Products in symbols of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "products",
    "Products in symbols",
    "MATH_SYMBOLS",
    32,
    tab="body",
    page="Products",
    about=(
        "SA-rot3",
        "SA-rot2",
        "A",
        "S3.3.1-zxz",
        "S3.3.2-rpy-xyz",
        "products of rotation matrices",
        "elementary rotations multiplied out",
        "rotation matrix in symbols",
        "symbolic",
    ),
    exports=(
        Export("copy LaTeX", "Product of rotations as LaTeX", ("symbolic", "equations")),
        Export("copy Python", "Product of rotations as a function", ("symbolic", "code", "program")),
    ),
)
