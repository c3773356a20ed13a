"""The choice of an example at the head of a bench, and what to look at in the one in place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from armlab.ui.form import Form, Typed
from armlab.ui.html import Inside, Markup, joined, tag


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


def _plain(text: str) -> Inside:
    return text


def examples(
    form: Form,
    known: Mapping[str, Shown],
    chosen: str,
    action: Typed,
    label: str = "Examples",
    written: Callable[[str], Inside] = _plain,
) -> Markup:
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
        Returns how an example's sentences are set.
    """
    titles = {"": "Choose …", **{key: example.title for key, example in known.items()}}
    chooser = form.select("example", "Example", titles, chosen, action, "Put one in place")
    look = tag("p.kit-look", written(known[chosen].says)) if chosen in known else None
    return joined(tag("div.kit-head", tag("span.dim", label), chooser), look)
