"""The page Frame chain of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "frame_chain",
    "Frames",
    "HIERARCHY_3",
    29,
    page="Frame chain",
    about=(
        "S3.1-chain",
        "S3.1-sphere",
        "S3.1-opcount",
        "S3.4-homogeneous",
        "3.1",
        "3.4",
        "frame chain",
        "frames",
        "homogeneous transform",
        "homogeneous transformation",
        "change of coordinates",
        "chain rule",
        "parent frame",
        "inverse of a transform",
        "number of operations",
        "transform tree",
    ),
)
