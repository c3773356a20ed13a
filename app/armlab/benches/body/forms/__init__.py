"""The page Forms of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "body",
    "Rotation",
    "CUBE",
    28,
    page="Forms",
    about=(
        "3.2",
        "3.3",
        "S3.1-rotation-matrix",
        "S3.2.2-inverse",
        "S3.2.3-quaternion",
        "S3.2.3-quat-from-R",
        "S3.3-minimal",
        "S3.3.1-euler12",
        "S3.3.1-zxz",
        "S3.3.2-rpy-xyz",
        "body",
        "euler",
        "roll pitch yaw",
        "quaternion",
        "gimbal lock",
        "gimbal rings",
        "axis angle",
        "nearest rotation",
        "rotation matrix",
        "double cover",
    ),
)
