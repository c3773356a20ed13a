"""The page Assign frames of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "trainer",
    "Assign frames",
    "PENCIL",
    14,
    tab="robot",
    about=(
        "S4.1-common-normal",
        "S4.1-dh",
        "S4.1-dh-caveats",
        "assign frames",
        "practise the DH rules",
        "exercise",
        "quiz",
        "DH quiz",
        "assigning frames",
    ),
)
