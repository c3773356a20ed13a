"""The page Order of rotations of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "order",
    "Order of rotations",
    "ARROWS_EXCHANGE",
    33,
    tab="body",
    page="Order",
    about=(
        "S5.1-commute",
        "S5.1-infinitesimal",
        "5.1",
        "finite rotations do not commute",
        "infinitesimal rotations",
        "commutator of rotations",
        "two rotations in both orders",
        "translations commute",
    ),
    exports=(Export("csv", "Angle between two orders as CSV", ("curves", "table", "second order")),),
)
