"""The page Identities of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "identities",
    "Identities",
    "EQUAL",
    92,
    tab="help",
    about=(
        "SA-trig",
        "SA-complex",
        "A",
        "trigonometric identities",
        "identity checker",
        "compare two expressions",
        "euler formula",
        "de moivre",
        "hyperbolic functions",
        "addition theorems",
        "half angle",
        "sum to product",
        "complex numbers",
    ),
    exports=(Export("csv", "Both sides of an identity as CSV", ("curves", "table")),),
)
