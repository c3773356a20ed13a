"""The page Pose accuracy of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "pose_accuracy",
    "Pose accuracy and repeatability",
    "FOCUS_CENTERED",
    61,
    tab="absolute_encoder",
    page="Pose accuracy",
    about=(
        "S1.7-accuracy-repeatability",
        "1.7",
        "ISO 9283",
        "pose accuracy",
        "pose repeatability",
        "accuracy of the arm",
        "repeatability of the arm",
        "AP and RP",
        "backlash",
        "error of the tool",
        "encoder on the joint",
    ),
)
