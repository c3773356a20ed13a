"""Facts of the absolute encoder that lessons can check."""

from __future__ import annotations

from armlab.benches.sensor.absolute.state import Absolute
from armlab.kin.sensors.absolute import CODES, changes
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _error(state: State, code: str) -> int:
    return int(state[Absolute].disks[code].error(state[Absolute].angle))


def _next_bits(state: State) -> int:
    part = state[Absolute]
    return int(changes(part.code, part.tracks)[part.disk.sector(part.angle)])


def _word(state: State) -> str:
    part = state[Absolute]
    return f"{int(part.disk.word(part.angle)):0{part.tracks}b}"


FACTS = Facts(
    __name__,
    (Absolute,),
    {
        "tracks": Fact("the number of tracks", lambda s: s[Absolute].tracks, kind="count"),
        "code": Fact("the code of the disk", lambda s: s[Absolute].code, kind="text", names=CODES),
        "resolution": Fact("the width of a sector", lambda s: s[Absolute].disk.width, "rad"),
        "angle": Fact("the angle of the disk", lambda s: s[Absolute].angle, "rad"),
        "sector": Fact(
            "the sector under the sensors", lambda s: s[Absolute].disk.sector(s[Absolute].angle), kind="count"
        ),
        "word": Fact("the word that the sensors see", _word, kind="text"),
        "read": Fact("the sector that is read", lambda s: s[Absolute].disk.read(s[Absolute].angle), kind="count"),
        "error": Fact("the error of the reading, in sectors", lambda s: _error(s, s[Absolute].code), kind="count"),
        "binary_error": Fact("the error of plain binary, in sectors", lambda s: _error(s, "binary"), kind="count"),
        "gray_error": Fact("the error of Gray code, in sectors", lambda s: _error(s, "gray"), kind="count"),
        "next_bits": Fact("the bits that change at the next edge", _next_bits, kind="count"),
        "worst": Fact("the largest error in a turn, in sectors", lambda s: s[Absolute].disk.pieces.worst, kind="count"),
        "wrong": Fact("the part of the turn with a wrong reading", lambda s: s[Absolute].disk.pieces.wrong),
        "offset": Fact("how far the sensor is ahead, in sectors", lambda s: s[Absolute].offset),
    },
)
