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
        "S3.2.2-inverse",
        "S3.2.3-quaternion",
        "S3.2.3-quat-from-R",
        "S3.3.1-euler12",
        "S3.3.1-zxz",
        "S3.3.2-rpy-xyz",
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
