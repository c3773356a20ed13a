"""Identities of the appendix of the notes in groups, and some that look right and are not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.help.identities.state import Identities, Kinds
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import setting
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Identity:
    """Two formulas.

    Attributes
    ----------
    key, group : str
    left, right : str
        As they are typed.
    holds : bool
    kinds : tuple of (str, str)
        Kinds of variables that are not the usual ones.
    says : str
        A sentence on what to look at.
    """

    key: str
    group: str
    left: str
    right: str
    holds: bool = True
    kinds: Kinds = ()
    says: str = ""

    @property
    def title(self) -> str:
        """The equation as it is typed."""
        return f"{self.left} = {self.right}"


def _group(group: str, start: str, *equations: str) -> list[Identity]:
    """Return identities of a group with the keys ``start1``, ``start2``, ..."""
    sides = [equation.split(" = ") for equation in equations]
    return [Identity(f"{start}{k + 1}", group, left, right) for k, (left, right) in enumerate(sides)]


RIGHT: list[Identity] = [
    *_group(
        "Fundamental",
        "fundamental",
        "sin(x)^2 + cos(x)^2 = 1",
        "tan(x)^2 + 1 = sec(x)^2",
        "1 + cot(x)^2 = csc(x)^2",
        "tan(x) = sin(x)/cos(x)",
        "cot(x) = cos(x)/sin(x)",
        "sec(x) = 1/cos(x)",
        "csc(x) = 1/sin(x)",
    ),
    *_group(
        "Associated angles",
        "associated",
        "sin(π - x) = sin(x)",
        "cos(π - x) = -cos(x)",
        "sin(π + x) = -sin(x)",
        "cos(π + x) = -cos(x)",
        "sin(2π - x) = -sin(x)",
        "cos(2π - x) = cos(x)",
        "sin(π/2 - x) = cos(x)",
        "cos(π/2 - x) = sin(x)",
    ),
    *_group(
        "Sum and difference of angles",
        "sum",
        "sin(x + y) = sin(x) cos(y) + cos(x) sin(y)",
        "cos(x + y) = cos(x) cos(y) - sin(x) sin(y)",
        "tan(x + y) = (tan(x) + tan(y))/(1 - tan(x) tan(y))",
        "sin(x - y) = sin(x) cos(y) - cos(x) sin(y)",
        "cos(x - y) = cos(x) cos(y) + sin(x) sin(y)",
        "tan(x - y) = (tan(x) - tan(y))/(1 + tan(x) tan(y))",
    ),
    *_group(
        "Double and triple angles",
        "multiple",
        "sin(2x) = 2 sin(x) cos(x)",
        "cos(2x) = cos(x)^2 - sin(x)^2",
        "cos(2x) = 2 cos(x)^2 - 1",
        "cos(2x) = 1 - 2 sin(x)^2",
        "tan(2x) = 2 tan(x)/(1 - tan(x)^2)",
        "sin(3x) = 3 sin(x) - 4 sin(x)^3",
        "cos(3x) = 4 cos(x)^3 - 3 cos(x)",
        "tan(3x) = (3 tan(x) - tan(x)^3)/(1 - 3 tan(x)^2)",
    ),
    *_group(
        "Half angles",
        "half",
        "abs(sin(x/2)) = sqrt((1 - cos(x))/2)",
        "abs(cos(x/2)) = sqrt((1 + cos(x))/2)",
        "tan(x/2) = sin(x)/(1 + cos(x))",
        "tan(x/2) = (1 - cos(x))/sin(x)",
        "cos(x) = (1 - tan(x/2)^2)/(1 + tan(x/2)^2)",
        "sin(x) = 2 tan(x/2)/(1 + tan(x/2)^2)",
    ),
    *_group(
        "Sums and products",
        "product",
        "sin(x) + sin(y) = 2 sin((x + y)/2) cos((x - y)/2)",
        "sin(x) - sin(y) = 2 cos((x + y)/2) sin((x - y)/2)",
        "cos(x) + cos(y) = 2 cos((x + y)/2) cos((x - y)/2)",
        "cos(x) - cos(y) = -2 sin((x + y)/2) sin((x - y)/2)",
        "sin(x) sin(y) = (cos(x - y) - cos(x + y))/2",
        "cos(x) cos(y) = (cos(x - y) + cos(x + y))/2",
        "sin(x) cos(y) = (sin(x + y) + sin(x - y))/2",
    ),
    *_group(
        "Exponentials",
        "exponential",
        "e^(i x) = cos(x) + i sin(x)",
        "cos(x) = (e^(i x) + e^(-i x))/2",
        "sin(x) = (e^(i x) - e^(-i x))/(2i)",
        "tan(x) = (e^(i x) - e^(-i x))/(i (e^(i x) + e^(-i x)))",
        "(cos(x) + i sin(x))^n = cos(n x) + i sin(n x)",
    ),
    *_group(
        "Hyperbolic functions",
        "hyperbolic",
        "sinh(x) = (e^x - e^(-x))/2",
        "cosh(x) = (e^x + e^(-x))/2",
        "tanh(x) = sinh(x)/cosh(x)",
        "sinh(i x) = i sin(x)",
        "cosh(i x) = cos(x)",
    ),
    *_group(
        "Complex numbers",
        "complex",
        "z = abs(z) e^(i arg(z))",
        "abs(x + i y) = sqrt(x^2 + y^2)",
        "arg(x + i y) = atan2(y, x)",
        "abs(z)^2 = z conj(z)",
    ),
    *_group(
        "Periods and symmetry",
        "period",
        "sin(x + 2k π) = sin(x)",
        "cos(x + 2k π) = cos(x)",
        "tan(x + k π) = tan(x)",
        "sin(-x) = -sin(x)",
        "cos(-x) = cos(x)",
        "tan(-x) = -tan(x)",
    ),
]
"""Identities of the appendix, which hold."""

DOUBTFUL = "Do they hold?"

WRONG: list[Identity] = [
    Identity(
        "argument",
        DOUBTFUL,
        "arg(x + i y)",
        "atan(y/x)",
        False,
        says="It holds for x > 0 only. Elsewhere atan is half a turn off⟦: the appendix of the notes prints it so⟧.",
    ),
    Identity(
        "carried",
        DOUBTFUL,
        "r cos(alpha + theta)",
        "r cos(alpha) cos(theta) - r sin(alpha) sin(alpha)",
        False,
        says="The first component of a vector that is turned from the angle α by θ: one letter is wrong⟦, as before "
        "3.16 in the notes⟧.",
    ),
    Identity(
        "eigenvalue",
        DOUBTFUL,
        "(e^(i theta))^2 + 2 cos(theta) e^(i theta) + 1",
        "0",
        False,
        says="e to the iθ is an eigenvalue of a rotation, and should solve its equation: one sign is wrong⟦ (3.60)⟧.",
    ),
    Identity(
        "entry",
        DOUBTFUL,
        "sin(phi) cos(psi) + cos(phi) cos(theta) sin(psi)",
        "sin(phi) sin(psi) + cos(phi) cos(theta) sin(psi)",
        False,
        says="On the left, entry (2,1) of the product of rotations about z, x and z; on the right, one function of "
        "it is another one⟦ (3.82)⟧.",
    ),
    Identity(
        "root",
        DOUBTFUL,
        "sin(x/2)",
        "sqrt((1 - cos(x))/2)",
        False,
        says="A root has no sign: it holds where sin(x/2) is positive. Formulas with ± leave the sign to the reader.",
    ),
    Identity(
        "inverse",
        DOUBTFUL,
        "atan(tan(x))",
        "x",
        False,
        says="tan forgets whole half turns, and atan returns the angle between −π/2 and π/2.",
    ),
    Identity(
        "linear",
        DOUBTFUL,
        "sin(x + y)",
        "sin(x) + sin(y)",
        False,
        says="The sine of a sum is not the sum of the sines.",
    ),
]
"""Equations that look right, and are not."""

EXAMPLES = Registry("example", (*RIGHT, *WRONG))


def groups() -> dict[str, dict[str, str]]:
    """Return the titles of the identities by group and key."""
    found: dict[str, dict[str, str]] = {}
    for key, identity in EXAMPLES.items():
        found.setdefault(identity.group, {})[key] = identity.title
    return found


@dataclass(frozen=True)
class ChooseIdentity(Command):
    """Put both sides of an identity in place."""

    key: str
    label: ClassVar[str] = "identity"

    def apply(self, state: State) -> State:
        """Return the state with the identity."""
        found = EXAMPLES[self.key]
        return setting(state, Identities, {"left": found.left, "right": found.right, "kinds": found.kinds})


def example_of(state: State) -> str:
    """Return the key of the identity that is in place; empty if there is none."""
    part = state[Identities]
    now = part.left, part.right, part.kinds
    return next((key for key, each in EXAMPLES.items() if (each.left, each.right, each.kinds) == now), "")


BENCH = Bench("identities", 90, EXAMPLES, ChooseIdentity)
