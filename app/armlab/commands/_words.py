"""Commands, facts and examples of the benches as Markdown, made from the code."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from armlab.page import Page
from armlab.plugins import constant_of
from armlab.registry import known_name
from armlab.session.arguments import Argument
from armlab.session.bench import benches
from armlab.session.facts import KINDS, Fact, facts_of_benches
from armlab.session.words import Word, pages_with_words, words_of


def words_listed(pages: Sequence[str] = ()) -> str:
    """Return the list of some pages such as ``"velocity.statics"``, or of all of them and all examples.

    Raises
    ------
    UnknownName
        There is no such page.
    """
    for page in pages:
        known_name("page", page, pages_with_words())
    lines = [line for page in pages or pages_with_words() for line in _page(page)]
    return "\n".join(lines if pages else [*lines, *_examples()]) + "\n"


def _page(page: str) -> Iterator[str]:
    """Yield the lines of a page; none of one without commands and facts."""
    commands, facts = words_of(page), facts_of_benches().get(page)
    if not commands and facts is None:
        return
    about = constant_of(pages_with_words()[page], "PAGE", Page)
    yield from (f"### `{page}`", "", f'The page *{about.name}*, `panel = "{about.key}"`.', "")
    if commands:
        yield from ("| command | arguments | what it does |", "|---|---|---|")
        yield from map(_command, commands.values())
        yield ""
    if facts is not None:
        yield from ("| fact | what it is | kind |", "|---|---|---|")
        for name, fact in facts.facts.items():
            unit = f", {fact.unit}" if fact.unit else ""
            title = f"{fact.title} ({fact.only})" if fact.only else fact.title
            yield f"| `{page}.{name}` | {_cell(title)} | {_kind(fact)}{unit} |"
        yield ""


def _kind(fact: Fact) -> str:
    """Return the kind of a fact, and the texts that it can be where these are keys."""
    *others, last = fact.names or ("",)
    return f"{KINDS[fact.kind]}: {', '.join(others)} or {last}" if others else KINDS[fact.kind]


def _command(word: Word) -> str:
    arguments = "; ".join(map(_argument, word.arguments)) or "–"
    return f"| `{word.name}` | {arguments} | {_cell(word.says)} |"


def _argument(argument: Argument) -> str:
    optional = "" if argument.needed else " (may be left out)"
    about = f": {_cell(argument.about)}" if argument.about else ""
    return f"`{argument.name}` {_cell(argument.kind.says)}{about}{optional}"


def _cell(text: str) -> str:
    """Return a text that stays in one cell of a table."""
    return text.replace("``", "`").replace("|", "\\|")


def _examples() -> Iterator[str]:
    yield from ("### Examples", "", '| bench | `example = "BENCH/NAME"` |', "|---|---|")
    for key, bench in benches().items():
        yield f"| `{key}` | {', '.join(f'`{name}`' for name in bench.examples)} |"
