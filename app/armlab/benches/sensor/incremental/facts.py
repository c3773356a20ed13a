"""Facts of the incremental encoder that lessons can check."""

from __future__ import annotations

from armlab.benches.sensor.incremental.counting import Counted, Now, electrical_angle, led, now
from armlab.benches.sensor.incremental.state import RULES, Incremental
from armlab.kin.sensors.quadrature import DECODERS
from armlab.session.facts import Fact, Facts
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State


def _now(state: State) -> Now:
    return state.derived(now)


def _chosen(state: State) -> Counted:
    return _now(state).counted[state[Incremental].decoder]


def _one_way(state: State) -> int:
    """Return the count with both orders of the edges taken for one direction, whatever is chosen."""
    part = state[Incremental]
    return int(DECODERS[part.decoder].one_way().count(part.signals.levels)[-1])


def _both_ways(state: State) -> int:
    part = state[Incremental]
    return int(DECODERS[part.decoder].count(part.signals.levels)[-1])


FACTS = Facts(
    __name__,
    (Incremental, Timeline),
    {
        "pulses": Fact("the number of periods in a turn", lambda s: s[Incremental].pulses, kind="count"),
        "decoder": Fact(
            "the rule of counting",
            lambda s: s[Incremental].decoder,
            kind="text",
            names={key: each.title for key, each in DECODERS.items()},
        ),
        "rule": Fact(
            "the directions for which both orders of the edges are taken",
            lambda s: s[Incremental].rule,
            kind="text",
            names=RULES,
        ),
        "per_period": Fact("D, the counts in a period", lambda s: _chosen(s).per_period, kind="count"),
        "resolution": Fact("AR, the angle of a count", lambda s: _chosen(s).resolution, "rad"),
        "angle": Fact("the angle of the disk", lambda s: _now(s).angle, "rad"),
        "electrical": Fact(
            "the electrical angle within a period", lambda s: electrical_angle(s[Incremental], _now(s).angle), "rad"
        ),
        "count": Fact("the count", lambda s: _chosen(s).count, kind="count"),
        "measured": Fact("the angle that the count stands for", lambda s: _chosen(s).angle, "rad"),
        "missed": Fact("the counts that are wrong", lambda s: _chosen(s).missed, kind="count"),
        "counts": Fact(
            "the counts of all rules", lambda s: [each.count for each in _now(s).counted.values()], kind="numbers"
        ),
        "edges": Fact("the number of edges of A and B", lambda s: len(s[Incremental].signals.times), kind="count"),
        "way": Fact(
            "the angle from start to end", lambda s: s[Incremental].motion.angles[-1] - s[Incremental].start, "rad"
        ),
        "moves": Fact("the number of moves", lambda s: len(s[Incremental].moves), kind="count"),
        "lead": Fact(
            "1 if A leads B in most of the moves, −1 if B leads A", lambda s: led(s[Incremental]), kind="count"
        ),
        "direction": Fact("1 if A led B at the last edge, −1 if B led A", lambda s: _now(s).direction, kind="count"),
        "zero_found": Fact("whether Z has come by", lambda s: _now(s).found, kind="truth"),
        "unevenness": Fact(
            "the largest gap between counts over equal gaps, minus 1",
            lambda s: DECODERS[s[Incremental].decoder].unevenness,
        ),
        "opposite_count": Fact("the count in the end with opposite directions", _both_ways, kind="count"),
        "one_way_count": Fact("the count in the end with one direction for both orders", _one_way, kind="count"),
    },
)
