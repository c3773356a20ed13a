"""The page Share of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "share",
    "Share",
    "SHARE",
    61,
    tab="picture",
    about=("link", "QR code", "save", "worksheet", "share link", "url", "phone", "print", "report"),
    exports=(
        Export("make-link", "Link and QR code to this arm", ("share", "url", "copy link")),
        Export("markdown", "Worksheet in Markdown", ("report", "handout")),
        Export("latex", "Worksheet in LaTeX", ("report", "handout")),
    ),
)
