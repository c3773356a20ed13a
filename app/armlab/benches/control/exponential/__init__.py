"""The page Matrix exponential of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "exponential",
    "Matrix exponential",
    "SUPERSCRIPT",
    47,
    tab="control",
    about=(
        "S1.3-matrix-exp",
        "S1.3-error-dynamics",
        "1.3",
        "matrix exponential",
        "eigenvectors",
        "diagonalisation",
        "linear system",
        "expm",
        "eigenvalues",
    ),
    exports=(
        Export("csv", "Errors over time as CSV", ("e^At", "curves", "table")),
        Export("copy LaTeX", "Matrix exponential as LaTeX"),
    ),
)
