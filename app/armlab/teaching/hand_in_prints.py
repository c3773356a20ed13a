"""Comparison of two hand-ins, to find out whether one was copied from the other."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable

from armlab.session.state import Json


def prints_of(progress: Json, parts: Json) -> frozenset[str]:
    """Return what two hand-ins have in common only when one is made of the other.

    The whole evidence of everything done counts, with its time, which is a number of sixteen digits: two people who do
    the same do not take the same time. Besides that, all of the work together counts.

    Parameters
    ----------
    progress, parts : Json
        Data of a file, which may contain anything.
    """
    done = [*_timed(progress, "evidence", _seconds_seen), *_timed(progress, "right", _seconds_typed)]
    some = [data for name in ("evidence", "right") if isinstance(data := progress.get(name), dict) and data]
    whole = [["all", progress, parts]] if some else []
    return frozenset(
        hashlib.sha256(json.dumps(each, sort_keys=True).encode("utf-8", "replace")).hexdigest()
        for each in (*done, *whole)
    )


def _timed(progress: Json, key: str, seconds: Callable[[Json], float]) -> list[Json]:
    found = progress.get(key)
    if not isinstance(found, dict):
        return []
    return [[key, name, data] for name, data in found.items() if seconds(data) > 0.0]


def _seconds_seen(evidence: Json) -> float:
    return _number(evidence.get("seconds")) if isinstance(evidence, dict) else 0.0


def _seconds_typed(answer: Json) -> float:
    return _number(answer[1]) if isinstance(answer, list) and len(answer) == 2 else 0.0


def _number(value: Json) -> float:
    return value if isinstance(value, float) and value == value else 0.0
