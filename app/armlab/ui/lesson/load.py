"""The button that opens work which was saved as a file."""

from __future__ import annotations

from armlab.session.hand_in import MOST


def load_work(bound: str) -> str:
    """Return the button; ``bound`` are the attributes by which the text of the file is sent, as of `Form.bound`."""
    hint = "Go on with work that you have saved, also at another computer"
    return (
        f'<label class="chip" title="{hint}">Open saved work'
        f'<input type="file" accept=".json" data-most="{MOST}" {bound}></label>'
    )
