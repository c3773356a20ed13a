"""The page By hand of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "by_hand",
    "By hand",
    "TARGET_ARROW",
    32,
    tab="target",
    about=(
        "S4.3-tan-half",
        "S4.3.2-methods",
        "S4.3.3-ik-2R",
        "S4.3.4-ik-polar-rrp",
        "S4.3.5-ik-elbow",
        "closed form",
        "derivation",
        "law of cosines",
        "Pieper",
    ),
)
