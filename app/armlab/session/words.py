"""The commands of all benches by their words, such as ``velocity.statics.set_component``, found by folder.

A word is there for every public command of a page whose arguments can be written in a file. A command that is an event
of a drag, with an argument ``drag`` that says of which, has none. The fields that a part declares are set by the word
``set`` of its page, such as ``control.loop.set``; ``put`` takes a bench as the lab has saved it.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial

from armlab.content.bench_words import BenchWord
from armlab.errors import InputError, PluginError, UnknownName
from armlab.plugins import BENCHES, bench_pages, modules_of_page
from armlab.registry import known_name
from armlab.session.arguments import TEXT, Argument, WrongArgument, arguments_of, read_arguments
from armlab.session.field_words import SetFields, field_arguments
from armlab.session.fields import FieldPart
from armlab.session.put_words import PutPart, put_words
from armlab.session.state import Command, part_types

OF_A_DRAG = "drag"
"""Name of the argument that connects a command with the drag to which it belongs."""


@dataclass(frozen=True)
class Word:
    """A command of a bench that lessons can use.

    Attributes
    ----------
    name : str
        Such as ``velocity.statics.set_component``.
    says, label : str
        Description in a sentence, and a name of a word or two, or empty.
    arguments : tuple of Argument
    make : callable
        Takes the arguments by their names and returns the command.
    """

    name: str
    says: str
    label: str
    arguments: tuple[Argument, ...]
    make: Callable[..., Command]

    @classmethod
    def of(cls, name: str, command: type[Command], arguments: tuple[Argument, ...]) -> Word:
        """Return the word of a command; its text is the first sentence of the command's docstring."""
        text = (inspect.getdoc(command) or "").partition("\n\n")[0]
        label = command.label if isinstance(command.label, str) and command.label != Command.label else ""
        return cls(name, " ".join(text.split()), label, arguments, command)


@cache
def pages_with_words() -> dict[str, str]:
    """Return the packages of all pages by the beginning of their words, such as ``velocity.statics``."""
    return {package.removeprefix(f"{BENCHES}."): package for package in bench_pages()}


@cache
def words_of(page: str) -> dict[str, Word]:
    """Return the words of a page, such as ``velocity.statics``, in the order of its modules.

    Raises
    ------
    PluginError
        A module cannot be imported, or two commands of a page have one name.
    """
    found: dict[str, Word] = {}
    for each in (*_of_commands(page), *_of_fields(page), *_of_parts(page)):
        if each.name in found:
            raise PluginError(f"{pages_with_words()[page]}: two commands have the word {each.name!r}; rename one")
        found[each.name] = each
    return found


def _of_commands(page: str) -> Iterator[Word]:
    for command in _commands(pages_with_words()[page]):
        arguments = arguments_of(command)
        if arguments is not None and not any(argument.name == OF_A_DRAG for argument in arguments):
            yield Word.of(f"{page}.{snake_case(command.__name__)}", command, arguments)


def _of_fields(page: str) -> Iterator[Word]:
    """Yield a word for the fields of the part of a page, or one for each of several parts."""
    parts = [part for part in part_types() if lies_in(part, page) and issubclass(part, FieldPart)]
    for part in parts:
        name = f"{page}.set" if len(parts) == 1 else f"{page}.set_{part.key}"
        says = f"Set fields of {part.key}; what is left out stays."
        if arguments := field_arguments(part):
            yield Word(name, says, part.key, arguments, partial(SetFields.of, part))


def _of_parts(page: str) -> Iterator[Word]:
    """Yield for each part of a page a word that restores it as it was saved."""
    for name, part in put_words(page).items():
        saved = Argument("saved", TEXT, True, "what the lab has saved of it, in JSON")
        yield Word(name, f"Put {part.key} as it was saved.", PutPart.label, (saved,), partial(PutPart, part))


def lies_in(kind: type, page: str) -> bool:
    """Return whether a class belongs to a module of a page, such as ``velocity.statics``."""
    return kind.__module__.startswith(f"{BENCHES}.{page}.")


def word(name: str) -> Word:
    """Return a word by its name.

    Raises
    ------
    UnknownName
        There is no such page, or no such command of it; the text lists those there are.
    """
    page, _, _ = name.rpartition(".")
    words = words_of(known_name("page of a word", page, pages_with_words()))
    return words[known_name("word", name, words)]


def command_of(written: BenchWord) -> Command:
    """Return the command that a lesson file writes.

    Raises
    ------
    LessonError
        An unknown word, or a missing, wrong or unknown argument: with file, line, word and what is available.
    """
    try:
        known = word(written.word)
    except UnknownName as error:
        raise written.wrong("command", str(error)) from None
    try:
        return known.make(**read_arguments(known.arguments, written.given))
    except WrongArgument as error:
        raise written.wrong(error.key, f"{written.word}: {error.problem}") from None
    except InputError as error:
        raise written.wrong("", f"{written.word}: {error}") from None


def snake_case(name: str) -> str:
    """Return the name of a class as one of a word.

    >>> snake_case("SetComponent")
    'set_component'
    """
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _commands(package: str) -> Iterator[type[Command]]:
    """Yield the public commands that the modules of a page define."""
    for module in modules_of_page(package):
        for name, found in vars(module).items():
            if _is_command(found) and found.__module__ == module.__name__ and not name.startswith("_"):
                yield found


def _is_command(found: object) -> bool:
    """Return whether an object is a usable command, and not a base class of several."""
    return inspect.isclass(found) and issubclass(found, Command) and dataclasses.is_dataclass(found)
