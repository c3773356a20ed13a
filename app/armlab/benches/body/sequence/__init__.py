"""The page Euler & RPY angles of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "sequence",
    "Euler & RPY angles",
    "ARROWS_CROSS",
    31,
    tab="body",
    page="Euler & RPY",
    about=(
        "S3.1-elementary",
        "S3.3.1-euler12",
        "S3.3.1-zxz",
        "S3.3.2-rpy",
        "S3.3.2-rpy-xyz",
        "3.3",
        "Euler angles",
        "roll pitch yaw",
        "moving axes",
        "fixed axes",
        "intrinsic and extrinsic rotations",
        "pre-multiply and post-multiply",
        "theorem 2",
        "order of rotations",
    ),
)
