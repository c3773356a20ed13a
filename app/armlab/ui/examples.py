"""The choice of an example at the head of a bench, and what to look at in the one in place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from armlab.ui.form import Form, Typed
from armlab.ui.format import escaped


class Shown(Protocol):
    """What is shown of an example."""

    @property
    def title(self) -> str:
        """In the list."""
        ...

    @property
    def says(self) -> str:
        """What to look at, in a sentence or two."""
        ...


def examples(
    form: Form,
    known: Mapping[str, Shown],
    chosen: str,
    action: Typed,
    label: str = "Examples",
    written: Callable[[str], str] = escaped,
) -> str:
    """Return the choice among examples, and below what to look at.

    Parameters
    ----------
    form : Form
    known : mapping of str to example
        By key, in the order of the list.
    chosen : str
        Key of the one in place; empty when there is none.
    action : callable
        Gets the key of the one to put in place.
    label : str
    written : callable
        Returns the markup of what an example says.
    """
    titles = {"": "Choose …", **{key: example.title for key, example in known.items()}}
    chooser = form.select("example", "Example", titles, chosen, action, "Put one in place")
    look = f'<p class="kit-look">{written(known[chosen].says)}</p>' if chosen in known else ""
    return f'<div class="kit-head"><span class="dim">{label}</span>{chooser}</div>{look}'
