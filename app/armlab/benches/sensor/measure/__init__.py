"""The page Accuracy and repeatability of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "accuracy",
    "Accuracy and repeatability",
    "TARGET",
    59,
    tab="absolute_encoder",
    page="Accuracy",
    about=(
        "S1.7-accuracy-repeatability",
        "1.7",
        "accuracy",
        "repeatability",
        "precision",
        "bias",
        "spread",
        "dart board",
        "confidence interval",
        "standard deviation",
        "measurement error",
    ),
)
