"""Claims that a place, a page or a lesson, is about a row of the inventory, and what is read there to prove them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple


class Proof(NamedTuple):
    """A text that stands for a row, the place where it is to be found, and what is read there."""

    place: str
    text: str
    read: str


def amiss(
    claims: Mapping[str, Collection[str]],
    proofs: Mapping[str, Collection[Proof]],
    everything: Mapping[str, str],
    most: int,
) -> Iterator[str]:
    """Yield a sentence for each claim without a proof, and for each proof that proves nothing.

    Parameters
    ----------
    claims : mapping of str to collection of str
        By row, the places that claim it.
    proofs : mapping of str to collection of Proof
        By row, what is said to be read of it, once for each place.
    everything : mapping of str to str
        By place, all that is read there.
    most : int
        A text that is read at more than so many places which do not claim its row is not the row's own.
    """
    used: dict[tuple[str, str], str] = {}
    for row, places in claims.items():
        given = proofs.get(row, ())
        yield from (f"{row}: {said}" for said in _unmatched(places, [proof.place for proof in given]))
        for proof in given:
            strangers = [place for place, read in everything.items() if place not in places and proof.text in read]
            if proof.text not in proof.read:
                yield f"{row}: {proof.text!r} is not read at {proof.place}"
            if len(strangers) > most:
                yield f"{row}: {proof.text!r} is read as well at {', '.join(strangers)}, which do not claim it"
            if used.setdefault((proof.place, proof.text), row) != row:
                yield f"{row}: {proof.text!r} of {proof.place} is named for {used[proof.place, proof.text]} already"


def _unmatched(claimed: Collection[str], named: Collection[str]) -> Iterator[str]:
    """Yield where a place that claims is not named once, or one is named that does not claim."""
    yield from (f"{place} claims it; name what is read of it there" for place in claimed if place not in named)
    yield from (f"{place} does not claim it" for place in dict.fromkeys(named) if place not in claimed)
    yield from (f"{place} is named more than once" for place in claimed if list(named).count(place) > 1)
