"""Parts of the pages of films of a few steps: the bar that plays them, and a named matrix."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.film import time_of
from armlab.benches.body.forms.timing import ENDS
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import matrix
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.playing import play_button


def steps_bar(
    form: Form, state: State, clip: str, word: str, show: Callable[[int], Command], ends: tuple[float, ...] = ENDS
) -> Markup:
    """Return the button that plays a film, and one for its start and for the end of each step.

    Parameters
    ----------
    form : Form
    state : State
    clip : str
        Key of the film.
    word : str
        What a step is called.
    show : callable
        Returns the command that shows the film where that many steps have been made.
    ends : tuple of float
        Ends of the steps, seconds.
    """
    now = time_of(state, clip, ends[-1])
    chips = [
        form.chip(
            f"made {made}",
            f"{word} {made}" if made else "start",
            show(made),
            f"After this {word}" if made else f"Before the first {word}",
            now == time,
        )
        for made, time in enumerate((0.0, *ends))
    ]
    return tag("div.bar", play_button(form, state, clip, clip), chips)


def factor(name: Inside, values: NDArray[np.float64], now: bool = False) -> Markup:
    """Return a matrix under its name, marked if it is that of the present step."""
    return tag(classes("div.bo-factor", now=now), tag("small", name), matrix(values, 3))
