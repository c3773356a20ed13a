"""The page Joint drive of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "joint_drive",
    "Joint drive",
    "TARGET",
    59,
    tab="drive",
    about=(
        "resolution of a joint",
        "encoder of a joint",
        "counts per turn",
        "backlash of a joint",
        "gear of a joint",
        "lead screw of a prismatic joint",
        "error of the tool",
        "tool error",
        "accuracy of the tool",
        "positioning error",
        "worst case",
        "one count",
        "motors behind the joints",
        "zonotope",
    ),
)
