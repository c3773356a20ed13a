"""The page Errata of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "errata",
    "Errata",
    "FILE_ALERT",
    6,
    tab="lessons",
    about=(
        "errors in the course notes",
        "mistakes in the notes",
        "misprints",
        "corrections",
        "erratum",
        "printed formula",
        "wrong formula",
        "spot the error",
        "residual",
        "practice",
    ),
    exports=(
        Export("errata-html", "All errata as a page to print", ("printed and correct", "list", "HTML")),
        Export("errata-markdown", "All errata in Markdown", ("printed and correct", "list")),
    ),
)
