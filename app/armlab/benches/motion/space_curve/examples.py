"""Examples of sections 6.1, 6.3.2 and 6.3.3 of the notes, and what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.space_curve.laid import FORMULA, Point, kinds, made_curve
from armlab.benches.motion.space_curve.state import CLIP_KEY, SpaceCurve
from armlab.benches.motion.space_curve.turn import Triple
from armlab.kin.motion import free_law_types
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.parts.timeline import with_clip
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example; settings that it does not name keep their defaults.

    Attributes
    ----------
    key, title, says : str
        What to look at, in one sentence.
    sets : dict
        Fields of `armlab.benches.motion.space_curve.state.SpaceCurve`.
    """

    key: str
    title: str
    says: str
    sets: dict[str, Any] = field(default_factory=dict)


def _typed(x: str, y: str, z: str, **more: Any) -> dict[str, Any]:
    return _shown(curve=Chosen(FORMULA), formula=(x, y, z), **more)


def _through(key: str, points: tuple[Point, ...], law: str = "cubic", **options: Any) -> dict[str, Any]:
    return _shown(curve=Chosen.of(kinds(), key, **options), points=points, law=Chosen(law))


def _shown(**sets: Any) -> dict[str, Any]:
    start = {"law": Chosen("cubic"), "duration": 4.0, "by_length": False, "frame": True, "arrows": False}
    return {"shown": "curve", **start, **sets}


def _turn(axes: str, start: Triple, end: Triple, fixed: bool = False) -> dict[str, Any]:
    return {
        "shown": "turn",
        "axes": axes,
        "fixed": fixed,
        "start": degrees(*start),
        "end": degrees(*end),
        "other_way": False,
        "law": Chosen("cubic"),
        "duration": 4.0,
    }


def degrees(*angles: float) -> Triple:
    """Return three angles in radians."""
    x, y, z = (math.radians(angle) for angle in angles)
    return x, y, z


_SQUARE: tuple[Point, ...] = (
    (-0.6, -0.2, 0.15),
    (-0.2, -0.2, 0.15),
    (-0.2, -0.2, 0.55),
    (-0.6, -0.2, 0.55),
    (-0.6, -0.2, 0.15),
)
_CORNER: tuple[Point, ...] = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0))
_RING: tuple[Point, ...] = ((-0.2, -0.08, 0.3), (-0.38, 0.1, 0.4), (-0.56, -0.08, 0.5))

EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "frenet",
            "A plane curve⟦ (6.142)⟧",
            "It bends most at its start, κ(0) = 1/10 per metre, and its binormal b = (0.8, 0, 0.6) never "
            "changes: the torsion is 0, and the curve stays in a plane.",
            _typed("6s+2", "5s^2", "-8s"),
        ),
        Example(
            "by_length",
            "The same curve by its length",
            "It is the same curve with the same κ, but |p′| is 1 everywhere: p′ is the tangent itself, and p″ = κ n is "
            "perpendicular to it.",
            _typed("6s+2", "5s^2", "-8s", by_length=True, arrows=True),
        ),
        Example(
            "helix",
            "Helix: constant curvature and torsion",
            "Curvature and torsion are the same everywhere, and n always points to the axis.",
            _through("helix", ((-0.2, -0.08, 0.15), (-0.2, -0.08, 0.65)), radius=0.18, turns=2.0),
        ),
        Example(
            "twisted",
            "Twisted cubic (s, s², s³)",
            "Its torsion never vanishes: it leaves the plane of t and n at every point, and b turns about t.",
            _typed("s", "s^2", "s^3"),
        ),
        Example(
            "line",
            "A line, from rest to rest⟦ (1.27–1.39)⟧",
            "ṗ is ṡ times the way from a to b, and p̈ is s̈ times it: at both ends ṡ = 0, so the point rests, and the "
            "accelerations cancel over the whole time.",
            {
                **_through("line", ((0.0, 0.0, 0.0), (1.0, 2.0, 0.0)), "quintic"),
                "duration": 2.0,
                "arrows": True,
                "frame": False,
            },
        ),
        Example(
            "circle",
            "Circle through three points",
            "The circle of curvature is the circle itself, with its centre at (0, 0, 0.5) m and radius √5/2 m.",
            _through("circle", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 1.0))),
        ),
        Example(
            "centripetal",
            "Tangential and centripetal acceleration",
            "While ṡ is constant, the tangential part p′s̈ is zero, and what is left points to the centre: κ v².",
            {**_through("circle", _RING, "trapezoidal", full=True), "by_length": True, "arrows": True, "frame": False},
        ),
        Example(
            "clothoid",
            "Clothoid: from straight to curved",
            "The curvature grows from zero in proportion to the arc length, so the centripetal acceleration begins "
            "without a jump; at s = 0 there is no normal.",
            _through("clothoid", ((-0.6, -0.2, 0.4), (-0.2, 0.0, 0.4)), "constant", turn=math.pi),
        ),
        Example(
            "square",
            "Square: stop at the corners",
            "At each corner t jumps: the velocity would jump with it, so a motion has to stop there, or fly over.",
            _through("polyline", _SQUARE, "constant"),
        ),
        Example(
            "square_flown",
            "Square: fly over the corners",
            "The same square without a stop: each corner is cut by a parabola, between whose ends the curvature is not "
            "zero.",
            {**_through("overfly", _SQUARE, "constant", by="d1", amount=0.1, speed=0.4)},
        ),
        Example(
            "overfly",
            "Over-fly of B by d₁ = 0.2 m⟦ (6.114-6.133)⟧",
            "With v₁ = 0.5 and v₂ = 1 m/s the blend lasts ΔT = 0.8 s and d₂ = 0.4 m; the acceleration jumps to "
            "(−0.625, 1.25, 0) m/s² and back, it is not zero at the ends.",
            {
                **_through("overfly", _CORNER, "constant", by="d1", amount=0.2, speed=[0.5, 1.0]),
                "arrows": True,
                "frame": False,
            },
        ),
        Example(
            "still",
            "Straight, and not regular⟦ (6.12)⟧",
            "The curvature is 0 everywhere it exists, hence bounded, and yet p′ = 0 at s = 0.5: there the curve has no "
            "tangent and no parametrisation by its length.",
            _typed("-0.4+(2s-1)^3/4", "-0.1", "0.5"),
        ),
        Example(
            "cusp",
            "Cusp: the curve turns back at a point",
            "At s = 0.5 p′ is zero and t reverses at once; near that point the curvature grows without bound.",
            _typed("-0.4+(2s-1)^3/4", "-0.1", "0.3+(2s-1)^2/3"),
        ),
        Example(
            "spline",
            "Spline through points in space",
            "Position, direction and curvature are continuous at the points; the torsion jumps.",
            _through(
                "spline",
                ((-0.6, -0.1, 0.3), (-0.5, -0.25, 0.6), (-0.3, 0.1, 0.45), (-0.15, -0.15, 0.3)),
                ends="natural",
            ),
        ),
        Example(
            "wander",
            "Orientation: Euler angles wander⟦ (6.150)⟧",
            "From the same A to the same B: about one axis every tip moves along an arc of a circle; by ZXZ "
            "angles the tips wander off, and the total angle is larger.",
            _turn("zxz", (0.0, 60.0, 0.0), (120.0, 60.0, -120.0)),
        ),
        Example(
            "wander_far",
            "Orientation: nearly twice as far",
            "By yaw, pitch and roll it rotates through 245° to where a rotation about one axis leads in 132°; "
            "in between, both are half a turn apart.",
            _turn("zyx", (0.0, 40.0, 0.0), (150.0, 40.0, -120.0)),
        ),
        Example(
            "agree",
            "Orientation: where both are the same",
            "Only one angle changes, so both rotate about the same axis and do not differ.",
            _turn("zyx", (0.0, 0.0, 0.0), (120.0, 0.0, 0.0)),
        ),
        Example(
            "half_turn",
            "Orientation: half a turn, r or −r",
            "θ is 180°: the rotations about r and about −r are equally short; try “the other way”.",
            _turn("zyx", (0.0, 0.0, 0.0), (60.0, 0.0, 180.0)),
        ),
        Example(
            "many_turns",
            "Orientation: angles that go round too far",
            "Headings 350° apart are orientations 10° apart: an angle that is taken as typed goes nearly once around.",
            _turn("zyx", (0.0, 20.0, 0.0), (350.0, 20.0, 0.0)),
        ),
    ),
)
"""Examples by key, in the order of the list."""

OWN_TIMES = ("square_flown", "overfly")
"""Examples that run in the time of their waypoints."""


@dataclass(frozen=True)
class ChooseExample(Command):
    """Load an example, and open its film at the start."""

    key: str
    label: ClassVar[str] = "example of a curve"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return with_clip(state.replace(example_part(self.key)), CLIP_KEY)


def example_part(key: str) -> SpaceCurve:
    """Return the part with an example loaded."""
    part = replace(SpaceCurve(), **EXAMPLES[key].sets, example=key)
    if key in OWN_TIMES:
        duration = made_curve(part.question).duration
        assert duration is not None
        part = replace(part, duration=duration, law=Chosen.of(free_law_types(), "constant"))
    part.check()
    return part


BENCH = Bench("space_curve", 50, EXAMPLES, ChooseExample)
