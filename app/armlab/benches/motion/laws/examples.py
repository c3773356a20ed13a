"""Examples of the bench of timing laws, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.bounds import Bounded
from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.benches.motion.laws.timing import Entry, Timing
from armlab.kin.motion import free_law_types
from armlab.kin.timing.table import BANG_COAST_BANG, PLUS_MINUS_ONE
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    laws : tuple of (str, dict)
        Key of the law and its options; with ``"as_typed": True`` it is not stretched.
    timing : Timing
    says : str
        What to look at, in one sentence.
    k : float
        Time scaling of the first law.
    bounded : Bounded
    bounds_shown : bool
        Whether the calculator is what to look at.
    """

    key: str
    title: str
    laws: tuple[tuple[str, dict[str, Any]], ...]
    timing: Timing
    says: str
    k: float = 1.0
    bounded: Bounded = field(default_factory=Bounded)
    bounds_shown: bool = False

    def part(self) -> Laws:
        """Return the bench with this example loaded."""
        entries = []
        for colour, (key, given) in enumerate(self.laws):
            options = {name: value for name, value in given.items() if name != "as_typed"}
            chosen = Chosen.of(free_law_types(), key, **options)
            entries.append(Entry(chosen, bool(given.get("as_typed")), colour))
        return Laws(
            tuple(entries),
            self.timing,
            k=self.k,
            bounded=self.bounded,
            bounds_shown=self.bounds_shown,
            example=self.key,
        )


def _rows(rows: Any) -> list[list[float]]:
    return [list(map(float, row)) for row in rows]


_REST: tuple[tuple[str, dict[str, Any]], ...] = (("cubic", {}), ("quintic", {}))

EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "plus_minus_one",
            "Accelerations ±1 on [0, 8]⟦ (1.40–1.42)⟧",
            (("table", {"rows": _rows(PLUS_MINUS_ONE), "as_typed": True}),),
            Timing(duration=8.0, speed=None, acceleration=None, jerk=None),
            "The areas under s̈ cancel, so ṡ(8) = 0, and those under ṡ too, so s(8) = 0: the motion comes back "
            "to where "
            "it began, at rest.",
        ),
        Example(
            "bang_coast_bang",
            "Bang-coast-bang, L = 2, V = A = 1",
            (("trapezoidal", {}), ("table", {"rows": _rows(BANG_COAST_BANG), "as_typed": True})),
            Timing(True, 3.0, 2.0, 1.0, 1.0, None),
            "Full acceleration for T_s = V/A = 1 s, constant speed, full deceleration; the same accelerations "
            "entered as a table give the same law.",
        ),
        Example(
            "triangle",
            "Too short for V: the triangle, L = 0.5",
            (("trapezoidal", {}),),
            Timing(True, 2.0, 0.5, 1.0, 1.0, None),
            "The distance is shorter than V²/A = 1, so the speed peaks at √(LA) = 0.7071 1/s and does not reach V.",
        ),
        Example(
            "same_time",
            "Bang-bang, cubic and quintic in the same time",
            (("bang_bang", {}), *_REST),
            Timing(False, 2.0, 1.0, None, None, None),
            "In the same time bang-bang needs the smallest acceleration, and the highest speed: T²·max|s̈|/L is 4, 6 "
            "and 5.77, T·max|ṡ|/L is 2, 1.5 and 1.875.",
        ),
        Example(
            "smoothness",
            "Cubic, quintic, septic: jumps and classes",
            (*_REST, ("septic", {})),
            Timing(False, 2.0, 1.0, None, None, None),
            "The acceleration of the cubic jumps at both ends; that of the quintic begins at zero; with the septic the "
            "jerk begins at zero, too.",
        ),
        Example(
            "same_limits",
            "Trapezoid, cubic and quintic within the same limits",
            (("trapezoidal", {}), *_REST),
            Timing(True, 2.0, 1.0, 1.0, 2.0, None),
            "Within the same V and A the trapezoid arrives first; the polynomials reach one limit, and only for "
            "an instant.",
        ),
        Example(
            "double_s",
            "Double S against trapezoid: bounded jerk",
            (("double_s", {}), ("trapezoidal", {})),
            Timing(True, 2.0, 2.0, 1.0, 1.5, 5.0),
            "The double S takes a little longer and its acceleration has no jumps; that of the trapezoid jumps four "
            "times, each time with an infinite jerk.",
        ),
        Example(
            "cosine",
            "Cosine⟦ (6.57–6.64)⟧",
            (("cosine", {}), ("cubic", {})),
            Timing(False, 2.0, 1.0, None, None, None),
            "Half a wave of a cosine is close to the cubic, and its acceleration jumps at both ends, too: π²/2 L/T² "
            "there.",
        ),
        Example(
            "end_speeds",
            "End speeds that are not zero",
            (("trapezoidal", {"sdot_start": 0.3, "sdot_end": 0.6}), ("double_s", {"sdot_start": 0.3, "sdot_end": 0.6})),
            Timing(True, 2.0, 1.5, 1.0, 2.0, 10.0),
            "Both laws begin at 0.3 and end at 0.6 1/s, as pieces of a longer motion do; the areas under ṡ are 1.5 all "
            "the same.",
        ),
        Example(
            "slower",
            "Time scaling: slower until V and A are kept⟦ (6.163)⟧",
            (("quintic", {}),),
            Timing(False, 1.0, 2.0, 2.0, 8.0, None),
            "In 1 s the peak speed of 3.75 1/s is too much for V = 2; with k = 1.875 it equals V, and the "
            "acceleration falls to 1/k² of its value.",
            k=1.875,
        ),
        Example(
            "faster",
            "Time scaling: faster up to the limits⟦ (6.163)⟧",
            (("quintic", {}),),
            Timing(False, 4.0, 2.0, 2.0, 8.0, None),
            "In 4 s no limit is reached; k = 0.46875 is less than 1 and speeds the law up until its peak speed "
            "equals V = 2.",
            k=0.46875,
        ),
        Example(
            "bound",
            "Bound of speed⟦ of the example 6.34–6.44⟧",
            _REST,
            Timing(True, 2.0, 1.0, 0.5, None, None),
            "Joint 2 decides: V = min(3/4, 2/4) = 1/2; both |dq/ds| are largest at s = 1, an end of the path.",
            bounds_shown=True,
        ),
        Example(
            "no_bound",
            "A bound of acceleration that cannot be kept⟦ (6.33)⟧",
            _REST,
            Timing(False, 4.0, 1.0, 0.5, None, None),
            "At V = 1/2 the bends of the path alone take more than a_max = 1 of joint 2: A = −0.125; press “Lower V”.",
            bounded=Bounded(a_max=(1.0, 1.0), speed=0.5),
            bounds_shown=True,
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseLawExample(Command):
    """Load the laws, the timing and the path of an example, and put their film, if it is open, at its start."""

    key: str
    label: ClassVar[str] = "example of timing laws"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        part = replace(EXAMPLES[self.key].part(), signs=state[Laws].signs)
        part.check()
        timeline = state[Timeline]
        rewound = replace(timeline, time=0.0, playing=False) if timeline.clip == CLIP_KEY else timeline
        return state.replace(part, rewound)


BENCH = Bench("laws", 30, EXAMPLES, ChooseLawExample)
