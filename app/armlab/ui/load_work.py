"""The button that opens work saved as a file."""

from __future__ import annotations

from armlab.teaching.hand_in import MOST
from armlab.teaching.hand_in_open import OpenWork
from armlab.ui.form import Form
from armlab.ui.html import Markup, tag


def load_work(form: Form) -> Markup:
    """Return the button."""
    hint = "Continue work that you have saved, also on another computer"
    chosen = tag("input", type="file", accept=".json", data_most=MOST, **form.bound("lesson-load", OpenWork))
    return tag("label.chip", "Open saved work", chosen, title=hint)
