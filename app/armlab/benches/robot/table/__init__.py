"""The page DH table of the lab."""

from armlab.page import Export, Page

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
        "Denavit-Hartenberg table",
        "new arm",
        "own arm",
        "link lengths",
        "tool frame",
        "base frame",
        "import an arm",
        "paste a table",
    ),
    exports=(
        Export("save", "Arm as a robot file, TOML", ("own arm", "robot file")),
        Export("load", "Load a robot file or a table", ("import", "open", "TOML")),
        Export("copy CSV", "DH table as CSV", ("parameters",)),
        Export("copy LaTeX", "DH table as LaTeX", ("parameters", "report")),
        Export("copy Markdown", "DH table as Markdown", ("parameters", "report")),
    ),
)
