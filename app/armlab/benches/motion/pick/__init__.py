"""The page Pick & place of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "motion_pick",
    "Pick & place",
    "BOX",
    40,
    tab="motion",
    about=(
        "pick and place",
        "gripper",
        "boxes",
        "carry a box",
        "grasp",
        "palletising",
        "wait at a waypoint",
        "goal place",
    ),
)
