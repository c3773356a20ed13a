"""Examples of the matrix exponential, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.control.exponential.state import Exponential
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "notes",
        "Eigenvalues −1 and −2⟦ (1.58)⟧",
        Exponential(),
        "The series needs about fifteen terms for what T e^Λt T⁻¹ gives at once; the product in the other "
        "order, T⁻¹ e^Λt T, is another matrix⟦, the one printed in 1.58⟧.",
    ),
    PartExample(
        "decay",
        "Error dynamics, K = diag(2, 5)⟦ (1.46–1.49)⟧",
        Exponential(((-2.0, 0.0), (0.0, -5.0)), 0.5, 2.0, (0.1, -0.2), 6),
        "A is diagonal, so each entry of e^At is an exponential of its own⟦ (1.56)⟧: the error in y dies out faster "
        "than that in x, and the curve bends into the x axis.",
    ),
    PartExample(
        "turn",
        "A turn: eigenvalues ±j",
        Exponential(((0.0, -1.0), (1.0, 0.0)), 1.0, 6.2832, (1.0, 0.0), 6),
        "The exponential of a skew-symmetric matrix is a rotation by the angle t: its series are those of cos t "
        "and sin t, and eigenvalues and eigenvectors are complex.",
    ),
    PartExample(
        "spiral",
        "A spiral: eigenvalues −0.3 ± 2j",
        Exponential(((-0.3, -2.0), (2.0, -0.3)), 1.5, 8.0, (1.0, 0.0), 10),
        "The real part of the eigenvalues shrinks the turn; with a positive one the curve would run away.",
    ),
    PartExample(
        "saddle",
        "A saddle: eigenvalues 1 and −1",
        Exponential(((0.0, 1.0), (1.0, 0.0)), 1.5, 2.5, (-1.0, 1.2), 6),
        "Along one eigenvector everything dies out, along the other it grows: only a start on the first one would "
        "come to rest.",
    ),
    PartExample(
        "defective",
        "Not diagonalisable: double eigenvalue −1",
        Exponential(((-1.0, 1.0), (0.0, -1.0)), 1.0, 5.0, (0.0, 1.0), 6),
        "There is one eigenvector only, so T has no inverse and the product with it cannot be formed⟦ (1.58)⟧; the "
        "series and SciPy do not mind, and t e^−t appears.",
    ),
    PartExample(
        "almost_defective",
        "Almost not: eigenvalues −1 and −1.0001",
        Exponential(((-1.0, 1.0), (0.0, -1.0001)), 1.0, 5.0, (0.0, 1.0), 6),
        "The eigenvectors are almost parallel: T has an inverse, but some four of sixteen digits are lost.",
    ),
    PartExample(
        "hump",
        "Terms that grow first: eigenvalues −30 and −1",
        Exponential(((-30.0, 0.0), (0.0, -1.0)), 1.0, 1.0, (1.0, 1.0), 110),
        "The terms of e^−30 grow up to 8·10¹¹ before they fall, so that rounding leaves an error of 10⁻⁵ that no "
        "more terms can mend: nobody computes it this way.",
    ),
)


@dataclass(frozen=True)
class ChooseExponentialExample(Command):
    """Load the matrix, the time, the start and the number of terms of an example."""

    key: str
    label: ClassVar[str] = "example of the matrix exponential"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("exponential", 65, EXAMPLES, ChooseExponentialExample)
