"""The formula of each kind of path, in the letter of what runs along it."""

from __future__ import annotations

from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType

_FORMULAS: dict[str, str] = {
    "line": r"X(s)=X_A+s\,(X_B-X_A)",
    "polyline": r"X(s)=X_k+\frac{s-s_k}{s_{k+1}-s_k}(X_{k+1}-X_k)",
    "circle": r"X(s)=c+r\,(u\cos\alpha s+v\sin\alpha s)",
    "helix": r"X(s)=c+r\,(u\cos\alpha s+v\sin\alpha s)+h\,s\,w",
    "cubic": r"X(s)=a_0+a_1s+a_2s^2+a_3s^3",
    "quintic": r"X(s)=\sum_{k=0}^{5}a_ks^k",
    "polynomial": r"X(s)=\sum_{k=0}^{N}a_ks^k",
    "interpolating": r"X(s)=\sum_{k=0}^{N-1}a_ks^k",
    "spline": r"X_j(s)=\sum_{k=0}^{3}a_{jk}(s-s_j)^k",
    "lts_434": r"X_j(s)=\sum_{k=0}^{n_j}a_{jk}(s-s_j)^k",
    "overfly": r"X''(s)=0\ \text{or}\ \text{const.}",
    "blends": r"X''(s)=0\ \text{or}\ \text{const.}",
    "harmonic": r"X(s)=X_A+\frac{1-\cos\pi s}{2}(X_B-X_A)",
    "cycloidal": r"X(s)=X_A+(s-\frac{\sin 2\pi s}{2\pi})(X_B-X_A)",
    "exponential": r"X(s)=X_A+\frac{1-e^{-\lambda s}}{1-e^{-\lambda}}(X_B-X_A)",
    "clothoid": r"\kappa(s)=\kappa_0+\kappa_1s",
}

_SAYS: dict[str, str] = {
    "line": "Notes 6.1.",
    "polyline": "With corners at the knots: the arm has to stop there.",
    "circle": "Centre c and radius r from the three knots; u, v span their plane.",
    "helix": "A circle that advances along w.",
    "cubic": "Four coefficients for both ends and the velocities there.",
    "quintic": "Six coefficients for both ends, velocities and accelerations.",
    "polynomial": "As many coefficients as conditions at both ends.",
    "interpolating": "One polynomial through all N knots; with many knots it wanders.",
    "spline": "A cubic from each knot to the next, with equal velocities and accelerations where two meet.",
    "lts_434": "Degrees 4, 3, 4: lift-off, travel, set-down.",
    "overfly": "Straight lines, with a parabola instead of each corner: the knots between are flown over, not met.",
    "blends": "Straight lines, with a parabola instead of each corner.",
    "harmonic": "At rest at both ends as far as s is concerned.",
    "cycloidal": "Its first two derivatives are zero at both ends.",
    "exponential": "Fast first, slow at the end; with negative λ the other way round.",
    "clothoid": "The curvature grows evenly with the length.",
}


def formula_of(kind: PathType, letter: str) -> str:
    """Return the formula of a kind of path in LaTeX, with the letter of what it is a path of; empty for none known."""
    return _FORMULAS.get(kind.key, "").replace("X", rf"\mathbf{{{letter}}}")


def says_of(kind: PathType, path: Path | None) -> str:
    """Return a sentence on a kind of path, and the degree of one whose degree depends on the knots."""
    said = _SAYS.get(kind.key, "")
    several = kind.key in ("polynomial", "interpolating")
    return f"{said} Degree {path.degree}." if several and path is not None and path.degree is not None else said
