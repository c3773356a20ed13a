"""The choice of an example at the head of a bench, with a sentence on what to look at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from armlab.ui.form import Form, Typed
from armlab.ui.html import Inside, Markup, joined, tag


class Shown(Protocol):
    """Title and sentence of an example."""

    @property
    def title(self) -> str:
        """Title in the list."""
        ...

    @property
    def says(self) -> str:
        """A sentence or two on what to look at."""
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
    said: Callable[[str], str] = str,
) -> Markup:
    """Return the choice among examples, and below it the sentence of the chosen one.

    Parameters
    ----------
    form : Form
    known : mapping of str to example
        By key, in the order of the list.
    chosen : str
        Key of the loaded example; empty if there is none.
    action : callable
        Gets the key of the example to load.
    label : str
    written : callable
        Returns how an example's sentences are set.
    said : callable
        Returns a title or a sentence with its angles in the unit on screen, as `Units.said` does.
    """
    titles = {"": "Choose …", **{key: said(example.title) for key, example in known.items()}}
    chooser = form.select("example", "Example", titles, chosen, action, "Load an example")
    look = tag("p.kit-look", written(said(known[chosen].says))) if chosen in known else None
    return joined(tag("div.kit-head", tag("span.dim", label), chooser), look)
