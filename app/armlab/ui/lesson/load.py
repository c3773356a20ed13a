"""The button that opens work which was saved as a file."""

from __future__ import annotations

from armlab.session.hand_in import MOST
from armlab.session.hand_in_open import OpenWork
from armlab.ui.form import Form


def load_work(form: Form) -> str:
    """Return the button."""
    hint = "Go on with work that you have saved, also at another computer"
    return (
        f'<label class="chip" title="{hint}">Open saved work'
        f'<input type="file" accept=".json" data-most="{MOST}" {form.bound("lesson-load", OpenWork)}></label>'
    )
