"""The page Inverse velocity of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "solve",
    "Inverse velocity",
    "EQUAL",
    36,
    tab="velocity",
    about=(
        "S1.2-inverse-velocity",
        "S1.2.1-min-norm",
        "S1.2.1-kernel-3R",
        "S5.1.3-mobility",
        "S5.1.3-3R-examples",
        "S5.1.4-singularity",
        "S5.1.4-2R",
        "S5.1.4-rrp",
        "S5.1.5-minors",
        "S5.2.2-pinv",
        "S5.2.2-penrose",
        "S5.2.3-svd",
        "S5.2.3-sing2R",
        "S5.2.3-nullspace",
        "inverse of the Jacobian",
        "pseudo-inverse",
        "range and null space",
        "null space",
        "kind of singularity",
        "singular configuration",
        "self-motion of a redundant arm",
        "minimum norm",
    ),
)
