"""The page Arms of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "robot",
    "Robot",
    "ROBOT",
    10,
    page="Arms",
    about=(
        "SR-2R",
        "SR-3R-planar",
        "SR-3R-elbow",
        "SR-RRP",
        "SR-R4",
        "SR-UR10",
        "SR-6R-16",
        "SR-3P",
        "SR-Unimate",
        "SR-PUMA560",
        "SR-SCARA",
        "SR-stanford-cyl",
        "S1.1-joint-types",
        "S1.1-r4-robot",
        "catalogue of arms",
        "choose an arm",
        "all arms",
        "gallery",
        "switch the arm",
        "another robot",
    ),
)
