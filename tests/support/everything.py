"""What a lab finds in folders."""

from __future__ import annotations

from armlab.session.bench import benches
from armlab.session.facts import facts_of_benches
from armlab.session.job import jobs
from armlab.session.pages import pages
from armlab.session.parts.timeline import clips
from armlab.session.state import part_types
from armlab.ui.plugin import layers


def everything() -> dict[str, list[str]]:
    """Return the keys of all that is found, by kind."""
    parts = [part.key for part in part_types()]
    found = (pages(), parts, layers(), jobs(), clips(), benches(), facts_of_benches())
    kinds = ("page", "part", "layer", "job", "clip", "bench", "facts")
    return {kind: sorted(keys) for kind, keys in zip(kinds, found, strict=True)}
