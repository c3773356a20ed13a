"""The page Screw motion of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "screw",
    "Screw motion",
    "TORNADO",
    32,
    tab="frame_chain",
    about=(
        "S3.4-homogeneous",
        "3.4",
        "screw motion",
        "screw axis",
        "twist",
        "pitch of a screw",
        "matrix exponential of a twist",
        "chasles",
        "between two poses",
        "straight line and slerp",
        "se(3)",
    ),
)
