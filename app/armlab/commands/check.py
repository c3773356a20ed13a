"""``armlab check``: the verdicts on the work of a class, as files saved by the lab."""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from armlab.commands import CommandType
from armlab.errors import ArmlabError, InputError

if TYPE_CHECKING:
    from armlab.commands._found import Place
    from armlab.teaching.hand_in import Report
    from armlab.teaching.hand_in_reports import Judged

FORMATS = ("table", "csv", "gradescope")
ENDING = ".json"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    from armlab.commands._found import add_lessons_option

    parser.add_argument("lesson", metavar="LESSON", help="its name, or its file or folder; or that of an assignment")
    parser.add_argument(
        "--state",
        nargs="+",
        required=True,
        metavar="FILE",
        help="work saved by the lab; of a folder all .json files in it and one level below",
    )
    parser.add_argument(
        "--format", choices=FORMATS, default="table", help="table (default), csv (score in percent) or gradescope"
    )
    parser.add_argument("--out", metavar="FILE", help="where to write; for gradescope and several files a folder")
    parser.add_argument(
        "--students",
        type=Path,
        metavar="FILE",
        help="names, one a line, as for `lesson sheet`: the first was given variant 1; other work does not count; "
        "the table has one row for each name, in this order",
    )
    parser.add_argument("--verbose", action="store_true", help="in the table, also what is missing to each step")
    add_lessons_option(parser)


def run(options: argparse.Namespace) -> int:
    """Judge the files; return 0 when all of them could be."""
    from armlab.commands._found import Place
    from armlab.commands._lesson_sheet import names_of
    from armlab.teaching.hand_in_class import by_list, looked_at_together

    judged_as = _judge_of(Place(options.lessons), options.lesson)
    students = names_of(options.students) if options.students else None
    once: dict[Path, tuple[Path, str]] = {}
    for path, shown in files_of(options.state):
        once.setdefault(path.resolve(), (path, shown))
    files = list(once.values())
    names = _names([path for path, _ in files])
    judged = looked_at_together([judge_file(path, shown, judged_as) for path, shown in files], students)
    for one in judged:
        if one.report is None:
            print(f"armlab: {one.file}: {one.problem}", file=sys.stderr)
    if options.format == "gradescope":
        _gradescope(judged, names, options.out, {path.resolve() for path, _ in files})
    else:
        listed = judged if students is None else by_list(judged, students)
        _text(listed, options, {path.resolve() for path, _ in files})
    return 0 if all(one.report for one in judged) else 1


def files_of(given: Sequence[str]) -> Iterator[tuple[Path, str]]:
    """Yield files and their names in reports: those given, and those of folders given and one level below.

    Raises
    ------
    InputError
        Nothing is there, or no such file in a folder.
    """
    for each in given:
        path = Path(each)
        if not path.is_dir():
            if not path.exists():
                raise InputError(f"{each}: there is no such file or folder")
            yield path, str(path)
            continue
        found = sorted(entry for entry in (*path.glob("*"), *path.glob("*/*")) if _is_work(entry))
        if not found:
            raise InputError(f"{each}: there is no {ENDING} file in this folder, nor one level below")
        yield from ((entry, entry.relative_to(path).as_posix()) for entry in found)


def _judge_of(place: Place, typed: str) -> Callable[[str], Report]:
    """Return what gives the verdict on the text of a file: of the lesson or the assignment that was typed."""
    from armlab.teaching.hand_in import judge
    from armlab.teaching.hand_in_assignment import judge_assignment

    assigned = place.assignment(typed)
    if assigned is not None:
        return lambda text: judge_assignment(text, assigned.key)
    found = place.one(typed)
    found.lesson()
    return lambda text: judge(text, found.key)


def judge_file(path: Path, shown: str, judge: Callable[[str], Report]) -> Judged:
    """Return the verdict on a file, or why there is none."""
    from armlab.teaching.hand_in_reports import Judged
    from armlab.teaching.plain_text import printable

    file = printable(shown)
    try:
        return Judged(file, judge(_read(path)))
    except ArmlabError as error:
        return Judged(file, None, printable(str(error)))
    except OSError as error:
        return Judged(file, None, f"cannot be read: {error.strerror}")
    except Exception as error:
        # Nobody can list what a forged file may raise, and it must not be in the way of the others.
        return Judged(file, None, f"this is not work saved by the lab ({type(error).__name__})")


def _is_work(entry: Path) -> bool:
    hidden = entry.name.startswith(".") or entry.parent.name == "__MACOSX"
    return entry.name.lower().endswith(ENDING) and entry.is_file() and not hidden


def _read(path: Path) -> str:
    from armlab.teaching.hand_in import MOST

    with path.open("rb") as stream:
        data = stream.read(4 * MOST + 1)
    if len(data) > 4 * MOST:
        raise InputError(f"expected at most {4 * MOST // 1_000_000} MB, got more")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError("this is not work saved by the lab: it is not text in UTF-8") from None


def _names(paths: Sequence[Path]) -> list[str]:
    """Return a name of its own for the results of each file: its own name, with its folder where others have it."""
    bare = Counter(path.stem.casefold() for path in paths)
    taken: set[str] = set()
    names = []
    for path in paths:
        stem = path.stem if bare[path.stem.casefold()] == 1 else f"{path.absolute().parent.name}_{path.stem}"
        name, number = stem, 1
        while name.casefold() in taken:
            number += 1
            name = f"{stem}_{number}"
        taken.add(name.casefold())
        names.append(name)
    return names


def _text(judged: Sequence[Judged], options: argparse.Namespace, inputs: set[Path]) -> None:
    from armlab.teaching.hand_in_reports import rows, table

    if options.format == "csv":
        # Excel takes a file for UTF-8 only when it begins with a mark.
        _write(rows(judged), options.out, inputs, "utf-8-sig")
    else:
        _write(table(judged, options.verbose or len(judged) == 1), options.out, inputs, "utf-8")


def _gradescope(judged: Sequence[Judged], names: Sequence[str], out: str | None, inputs: set[Path]) -> None:
    from armlab.teaching.hand_in_reports import gradescope

    written: Callable[[Judged], str] = lambda one: json.dumps(gradescope(one), indent=1, ensure_ascii=False) + "\n"  # noqa: E731
    folder = out is not None and (len(judged) > 1 or out.endswith(("/", "\\")) or Path(out).is_dir())
    if not folder:
        if len(judged) > 1:
            raise InputError(f"{len(judged)} files give as many results: name a folder for them with --out")
        _write(written(judged[0]), out, inputs, "utf-8")
        return
    assert out is not None
    Path(out).mkdir(parents=True, exist_ok=True)
    for one, name in zip(judged, names, strict=True):
        _write(written(one), str(Path(out) / f"{name}{ENDING}"), inputs, "utf-8")


def _write(text: str, out: str | None, inputs: set[Path], encoding: str) -> None:
    """Write to a file or, without one, to the terminal; the work of students is never overwritten."""
    if out is None:
        print(text, end="")
        return
    if Path(out).resolve() in inputs:
        raise InputError(f"{out}: this is one of the files to judge; choose another place with --out")
    Path(out).write_text(text, encoding=encoding, newline="\n")


COMMAND = CommandType(
    "check", 10, "Judge work that students have saved: the same verdicts as on screen.", add_arguments, run
)
