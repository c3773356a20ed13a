"""``armlab lesson check``: whether lessons can be read, solved and trusted."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from armlab.commands import CommandType
from armlab.errors import ContentError, InputError

if TYPE_CHECKING:
    from armlab.commands._found import Found, Place
    from armlab.content.lesson import Lesson

VARIANTS = 4
MOST_VARIANTS = 1000

MORE = 40
"""Largest number of variants that are tried besides the first ones, for values that these do not have."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    from armlab.commands._found import add_lessons_option

    parser.add_argument(
        "lesson", nargs="*", metavar="LESSON", help="names, files, folders or assignments; all when left out"
    )
    parser.add_argument(
        "--variants",
        type=int,
        metavar="N",
        help=f"how many variants to try ({VARIANTS}, and up to {MORE} more for values that these do not have)",
    )
    add_lessons_option(parser)


def run(options: argparse.Namespace) -> int:
    """Print the problems of each lesson; return 0 when there are none."""
    from armlab.commands._found import Place

    if options.variants is not None and not 0 <= options.variants <= MOST_VARIANTS:
        raise InputError(f"--variants: expected 0 to {MOST_VARIANTS}, got {options.variants}")
    place = Place(options.lessons)
    chosen = [found for typed in options.lesson for found in _chosen(place, typed)] if options.lesson else place.all()
    for line in place.problems():
        print(line)
    count = len(place.problems())
    for found in {each.file: each for each in chosen}.values():
        problems = list(problems_of(found, options.variants))
        count += len(problems)
        for line in problems:
            print(line)
        if not problems:
            print(_without_problems(found, options.variants), flush=True)
    return 1 if count else 0


def _without_problems(found: Found, variants: int | None) -> str:
    lesson = found.lesson()
    steps, (numbers, whole) = len(lesson.steps), _tried(found, variants)
    where = f" in {len(numbers)} variants" if len(numbers) > 1 else ""
    rest = "" if whole else "; not all values of [variants] came up in them"
    return f"{found.key}: {steps} step{'s' if steps > 1 else ''}, no problems{where}{rest}"


def _tried(found: Found, variants: int | None) -> tuple[Sequence[int], bool]:
    """Return the variants to try, and whether they are enough: as many as were asked for, or with all values."""
    from armlab.content.lesson_head import variants_of

    of = variants_of(found.key, found.text())
    return of.to_try(VARIANTS, MORE) if variants is None else (of.to_try(variants, 0)[0], True)


def _chosen(place: Place, typed: str) -> list[Found]:
    """Return the lessons that are meant by a name, a file, a folder, or an assignment."""
    assigned = place.assignment(typed)
    return place.some(typed) if assigned is None else [place.one(key) for key in assigned.lessons]


def problems_of(found: Found, variants: int | None = None) -> Iterator[str]:
    """Yield a line for each thing wrong with a lesson, ``file:line: step 2: ...``.

    Its names are looked for, and it is played in its variant 0 and, if it varies, in variants 1 to ``variants``; when
    left out, in the first ones and in as many as it takes until all values have come up, see `Variants.to_try`.
    """
    from armlab.commands import _references, _translated
    from armlab.content.lessons import lesson, lessons

    try:
        first = found.lesson()
    except ContentError as error:
        yield _of_error(found, error)
        return
    wrong = [_of_error(found, error) for error in _references.of_words(first)]
    if wrong:
        yield from wrong
        return
    yield from _translated.of_translations(first)
    unknown = list(_names(found, first))
    yield from unknown
    yield from (_of_error(found, error) for error in lessons().amiss.get(found.key, ()))
    yield from _titles(found, first)
    if unknown:
        return  # what follows from a wrong name would be told once more, and elsewhere
    told: set[tuple[int, str]] = set()
    broken: dict[str, tuple[ContentError, list[int]]] = {}
    for number in _tried(found, variants)[0]:
        try:
            given = lesson(found.key, number)
        except ContentError as error:
            broken.setdefault(str(error), (error, []))[1].append(number)
            continue
        yield from _played(found, given, told)
    for what, numbers in broken.values():
        yield _of_error(found, what, numbers)


def _titles(found: Found, lesson: Lesson) -> Iterator[str]:
    """Yield the steps that have the title of an earlier one."""
    first: dict[str, int] = {}
    for i, step in enumerate(lesson.steps, start=1):
        if first.setdefault(step.title, i) != i:
            says = (
                f"its title is that of step {first[step.title]}; progress is kept under titles, give it one of its own"
            )
            yield f"{found.file}:{step.line}: step {i}: {says}"


def _names(found: Found, lesson: Lesson) -> Iterator[str]:
    from armlab.commands import _references
    from armlab.content.lesson_head import front_line

    for key, says in _references.of_front(lesson):
        yield f"{found.file}:{front_line(found.text(), key)}: {key}: {says}"
    for i, step in enumerate(lesson.steps):
        for says in _references.of_step(lesson, step):
            yield f"{found.file}:{step.line}: step {i + 1}: {says}"


def _played(found: Found, lesson: Lesson, told: set[tuple[int, str]]) -> Iterator[str]:
    """Yield the problems of a variant that no earlier one has."""
    from armlab.teaching.play import problems

    for problem in problems(lesson.key, lesson.variant):
        if (problem.step, problem.says) not in told:
            told.add((problem.step, problem.says))
            where = f" (variant {lesson.variant})" if lesson.varies else ""
            yield f"{found.file}:{problem.line}: step {problem.step}{where}: {problem.says}"


def _of_error(found: Found, error: ContentError, variants: Sequence[int] = ()) -> str:
    from armlab.commands._found import in_words

    which = ", ".join(map(str, variants))
    where = f"variant{'s' * (len(variants) > 1)} {which}: " if variants else ""
    file, name = PurePath(found.file), PurePath(error.file).name
    # A picture has no lines.
    place = f"{file}:{getattr(error, 'line', 1)}" if name == file.name else str(file.with_name(name))
    return f"{place}: {where}{in_words(error)}"


PART = CommandType(
    "check", 20, "Find what is wrong with lessons: mistakes in files, wrong solutions.", add_arguments, run
)
