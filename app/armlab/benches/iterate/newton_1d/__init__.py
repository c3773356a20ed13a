"""The page Newton in 1D of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "newton_1d",
    "Newton in 1D",
    "MATH_FUNCTION",
    34,
    tab="iterations",
    about=("S4.4.1-newton-scalar", "Newton-Raphson", "tangent", "root of an equation", "root finding", "Newton method"),
)
