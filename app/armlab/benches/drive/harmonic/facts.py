"""Facts of harmonic drives that lessons can check."""

from __future__ import annotations

from armlab.benches.drive.harmonic.film import counted_now
from armlab.benches.drive.harmonic.state import Harmonic
from armlab.kin.drive.strain_wave import FIXED, counted_teeth
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline

FACTS = Facts(
    __name__,
    (Harmonic, Timeline),
    {
        "flexspline": Fact("the teeth of the flexspline", lambda s: s[Harmonic].flexspline, kind="count"),
        "circular": Fact("the teeth of the circular spline", lambda s: s[Harmonic].drive.circular, kind="count"),
        "ratio": Fact("the ratio, negative against the input", lambda s: s[Harmonic].drive.ratio),
        "fixed": Fact("the part that is fixed", lambda s: s[Harmonic].fixed, kind="text", names=FIXED),
        "counted": Fact(
            "the teeth that the flexspline moves along the circular spline in a turn of the wave generator, counted",
            lambda s: float(counted_teeth(s[Harmonic].drive)),
        ),
        "moved": Fact(
            "the teeth that the flexspline has moved along the circular spline in the film",
            lambda s: counted_now(s).moved,
        ),
        "input_turns": Fact("the turns of the input in the film", lambda s: counted_now(s).turns),
        "output_turns": Fact("the turns of the output in the film", lambda s: counted_now(s).out),
    },
)
