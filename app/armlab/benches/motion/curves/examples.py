"""Examples of chapter 6: knots, curves and limits, what to look at, and differences from the notes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.knots import Knot
from armlab.benches.motion.curves.made import Drawn, Made, kinds
from armlab.benches.motion.curves.state import Curves
from armlab.kin.motion.law_types import free_law_types
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.state import Command, State

Given = tuple[str, dict[str, Any]]


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    knots : tuple of (float, float)
    paths : tuple of (str, dict)
        Kind of each curve, and its options that are not as they come.
    says : str
        What to look at, in one sentence.
    laws : tuple of str
        Keys of the laws of the curves; constant where there are no more.
    v_max, a_max : float or None
    """

    key: str
    title: str
    knots: tuple[Knot, ...]
    paths: tuple[Given, ...]
    says: str
    laws: tuple[str, ...] = ()
    v_max: float | None = None
    a_max: float | None = None

    @property
    def curves(self) -> tuple[Drawn, ...]:
        """The curves in the form in which the part keeps them."""
        laws = (*self.laws, *["constant"] * (len(self.paths) - len(self.laws)))
        return tuple(
            Drawn(i, Chosen.of(kinds(), key, **options), Chosen.of(free_law_types(), law))
            for i, ((key, options), law) in enumerate(zip(self.paths, laws, strict=True))
        )


RUNGE = tuple((float(k), 1.0 / (1.0 + 25.0 * (0.2 * k - 1.0) ** 2)) for k in range(11))
"""Eleven knots of a smooth curve, evenly spaced in time."""

EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "hermite",
            "Cubic with end velocities",
            ((0.0, 1.0), (2.0, 4.0)),
            (
                ("cubic", {"v_start": [0.7], "v_end": [-0.4]}),
                ("quintic", {"v_start": [0.7], "v_end": [-0.4]}),
            ),
            "Both start with velocity 0.7 and end with velocity −0.4; only the quintic can also start and end "
            "with zero acceleration.",
        ),
        Example(
            "quintic",
            "Quintic with six conditions",
            ((0.0, 0.3), (3.0, 2.0)),
            (("quintic", {"v_start": [0.5], "v_end": [-1.0], "a_start": [1.5], "a_end": [2.0]}),),
            "It goes beyond its end and comes back, because it has to arrive with a negative velocity: see the "
            "overshoot.",
        ),
        Example(
            "one_to_four",
            "From 1 to 4 in 2 s",
            ((0.0, 1.0), (2.0, 4.0)),
            (("cubic", {}), ("quintic", {})),
            "From rest, the acceleration of the cubic jumps to 4.5; that of the quintic starts at zero, and in "
            "return its velocity exceeds 2.5 in the middle.",
            v_max=2.5,
            a_max=5.0,
        ),
        Example(
            "degree_15",
            "Degree 15: cubic with quintic timing",
            ((0.0, 0.0), (4.0, math.pi)),
            (("cubic", {}), ("cubic", {})),
            "The same path with two laws: with the quintic s(t) it is a polynomial of degree 3 · 5 = 15 in t, "
            "slow at both ends and fast in between.",
            ("quintic",),
        ),
        Example(
            "courses",
            "Harmonic, cycloidal, exponential",
            ((0.0, 0.0), (2.0, 1.0)),
            (("harmonic", {}), ("cycloidal", {}), ("exponential", {})),
            "Only the cycloidal curve starts without a jump in acceleration; the exponential one even starts "
            "with a jump in velocity.",
        ),
        Example(
            "lts",
            "Lift-off, travel, set-down (4-3-4)",
            ((0.0, 0.0), (1.0, 0.2), (3.0, 1.8), (4.0, 2.0)),
            (("lts_434", {}), ("spline", {})),
            "Both are continuous up to the acceleration; with degrees 4, 3, 4 it is also zero at both ends: 14 "
            "equations "
            "for 5 + 4 + 5 coefficients.",
        ),
        Example(
            "blends",
            "Linear segments with parabolic blends",
            ((0.0, 0.0), (2.0, 1.0), (4.0, 0.5)),
            (
                ("blends", {"blend": [0.4], "ends": "moving"}),
                ("blends", {"blend": [1.6], "ends": "moving"}),
                ("blends", {"blend": [1.6], "ends": "moving", "shape": "quartic"}),
            ),
            "A longer blend needs less acceleration and passes farther from the knot: try other blend times.",
        ),
        Example(
            "wandering",
            "Eleven knots: polynomial against spline",
            RUNGE,
            (("interpolating", {}), ("spline", {"ends": "natural"})),
            "The single polynomial of degree 10 wanders between the outer knots; the spline stays near them.",
        ),
        Example(
            "ends",
            "Spline: clamped, natural, virtual knots",
            ((0.0, 0.0), (1.0, 1.0), (2.0, 0.5), (3.0, 2.0)),
            (
                ("spline", {}),
                ("spline", {"ends": "natural"}),
                ("spline", {"ends": "both", "virtual": [0.5, 2.5]}),
            ),
            "The clamped spline starts with an acceleration and the natural one with a velocity; two virtual "
            "knots make both zero.",
        ),
        Example(
            "fastest",
            "Uneven intervals, and the fastest ones",
            ((0.0, 0.0), (0.5, 1.0), (1.7, 0.5), (2.1, 2.0), (4.0, 1.0)),
            (("spline", {}),),
            "Because of its short intervals the curve exceeds both limits: press “Fastest intervals” and see "
            "which ones become longer.",
            v_max=2.0,
            a_max=6.0,
        ),
    ),
)
"""Examples by key, in the order of the list."""


NOTES: dict[str, tuple[str, ...]] = {
    "cubic": (
        "⟦Notes 6.50–6.54 and 6.173 divide vectors by q_f − q_i: that holds for one joint that moves, as here.⟧",
        "⟦Notes after 6.183 call the cubic continuous up to acceleration: from rest it is C1 only.⟧",
    ),
    "quintic": (
        "⟦Notes before 6.72 say degree 6 for the quintic of 6.72–6.73: it is 5.⟧",
        "⟦Notes 6.74 prints −5τ⁴: corrected to −15τ⁴.⟧",
    ),
    "polynomial": ("⟦Notes 6.74 prints −5τ⁴ for the quintic: corrected to −15τ⁴.⟧",),
    "harmonic": ("⟦Notes 6.60 has q′(T) = 0 for normalised time: q′(1) = 0 is meant.⟧",),
    "lts_434": ("⟦Notes 6.79–6.80 print one derivative too high at the end: corrected to q̇(t_f) = q̈(t_f) = 0.⟧",),
    "blends": (
        "⟦Notes 6.86–6.88 mix s and t: one parameter, t, is used; each blend begins half its time before the knot.⟧",
    ),
    "spline": (
        "⟦Notes 6.91 prints 3h_k³: corrected to 3h_k².⟧",
        "⟦Notes 6.95 swaps h_k² and h_k+1² (unseen with even intervals): corrected.⟧",
        "⟦Notes 6.97, list: “minimum curvature” is the least ∫q̈² dt.⟧",
    ),
}
"""Differences between the notes and the formulas used here, by kind of path."""

VIRTUAL = "⟦Notes 6.98 has q″(h_N): q̈(t_1) = q̈(t_N) = 0 is meant.⟧"
TIMED_CUBIC = "⟦Notes 6.6 has s + 3(π−1)s² − 2(π−1)s³, whose q′ is 1 at both ends: corrected to 3πs² − 2πs³.⟧"


def differences(made: Made) -> tuple[str, ...]:
    """Return the differences of the notes from a curve, each in a line that names the equation."""
    key, options = made.drawn.path.key, made.drawn.path.options
    lines = NOTES.get(key, ())
    if key == "spline" and options.get("ends") == "both":
        lines = (*lines, VIRTUAL)
    return (TIMED_CUBIC, *lines[:1]) if key == "cubic" and made.drawn.law.key != "constant" else lines


@dataclass(frozen=True)
class ChooseExample(Command):
    """Load the knots, the curves and the limits of an example."""

    key: str
    label: ClassVar[str] = "example of curves"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        example = EXAMPLES[self.key]
        part = Curves(
            example.knots,
            example.curves,
            (example.v_max, example.a_max),
            degree=state[Curves].degree,
            example=example.key,
        )
        return state.replace(part)


BENCH = Bench("curves", 40, EXAMPLES, ChooseExample)
