"""The page Orientation of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "orientation",
    "Orientation",
    "ROTATE",
    26,
    tab="pose",
    about=(
        "3.2",
        "3.3",
        "S3.1-atan2",
        "S3.1-elementary",
        "SA-rot3",
        "axis and angle",
        "quaternion",
        "Euler angles",
        "roll pitch yaw",
        "rotation matrix",
        "rotation vector",
        "rpy",
        "convert an orientation",
    ),
    exports=(Export("copy NumPy", "Rotation matrix as NumPy", ("MATLAB", "LaTeX")),),
)
