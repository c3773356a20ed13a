"""The page Singularities of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "microscope",
    "Singularities",
    "ZOOM_IN",
    40,
    tab="velocity",
    about=(
        "S5.2.1-dls",
        "S5.1.4-singularity",
        "5.2.1",
        "singularity microscope",
        "damped least squares",
        "singular directions",
        "inverse condition",
        "wrist singularity",
        "singularity",
        "singular",
        "singularities",
        "DLS",
        "damping",
        "det J",
        "near a singularity",
    ),
)
