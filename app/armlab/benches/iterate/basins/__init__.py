"""The page Convergence map of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "basins",
    "Convergence map",
    "MAP",
    38,
    tab="iterations",
    about=(
        "S4.4.1-newton-ik",
        "S4.4.2-gradient",
        "4.4",
        "basins of attraction",
        "which solution a method finds",
        "start of an iteration",
        "convergence",
        "local minimum",
        "initial guess",
    ),
    exports=(Export("png", "Map of the basins as PNG", ("picture", "image"), "a map has been made"),),
)
