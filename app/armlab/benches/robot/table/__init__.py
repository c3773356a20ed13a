"""The page DH table of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "table",
    "DH table",
    "TABLE",
    11,
    tab="robot",
    about=(
        "S4.1-dh",
        "S4.1-dh-chain",
        "S4.1-dh-caveats",
        "(4.10-4.16)",
        "S4.3.2-methods",
        "DH table",
        "standard and modified convention",
        "Craig",
        "edit an arm",
    ),
)
