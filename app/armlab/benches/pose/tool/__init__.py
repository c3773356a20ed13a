"""The page Pose of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "pose",
    "Pose",
    "BRACKETS",
    25,
    about=(
        "S3.4-homogeneous",
        "S1.1-direct-kinematics",
        "S1.1-world-frame",
        "S3.1-rotation-matrix",
        "S3.1-cylindrical",
        "(3.109-3.115)",
        "S4.1-dh-chain",
        "matrix",
        "position",
        "coordinates",
        "end effector",
        "tcp",
        "homogeneous transformation",
        "transform",
        "frames",
        "transformation matrix",
    ),
    exports=(Export("copy NumPy", "Pose matrix as NumPy", ("MATLAB", "LaTeX", "transform")),),
)
