"""Films beside the one a test is about, of whichever benches there are."""

from __future__ import annotations

from armlab.session.parts.timeline import clips
from armlab.session.state import State


def another_clip(state: State, own: str) -> str:
    """Return the key of a film of another page that lasts longer than three seconds and leaves the arm where it is."""
    return next(key for key, clip in clips().items() if key != own and clip.panel and clip.duration(state) > 3.0)
