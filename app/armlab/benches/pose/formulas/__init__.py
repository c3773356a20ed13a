"""The page FK formulas of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "formulas",
    "FK formulas",
    "MATH_FUNCTION",
    27,
    tab="pose",
    about=(
        "S1.1-direct-kinematics",
        "S4.0-2R",
        "S4.1-dh-chain",
        "symbolic",
        "closed form of the direct kinematics",
        "symbolic kinematics",
        "equations of the arm",
        "sympy",
    ),
    exports=(
        Export("copy LaTeX", "Formulas of the arm as LaTeX", ("equations", "symbolic")),
        Export("copy Python", "Formulas of the arm as Python", ("code", "symbolic", "program")),
    ),
)
