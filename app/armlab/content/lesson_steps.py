"""The steps of a lesson: sections of Markdown with fenced blocks for tasks."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from armlab.content.actions import Action, read_begin, read_solution
from armlab.content.bench_words import placed
from armlab.content.check import StateCheck, read_state_check
from armlab.content.lesson import Step
from armlab.content.lesson_fields import Fields, example_name
from armlab.content.lesson_lines import LessonError, located
from armlab.content.lesson_text import Prose
from armlab.content.lesson_values import filled_data
from armlab.content.markdown import tokens_of
from armlab.content.question import Question, read_question
from armlab.content.reader import Table
from armlab.content.robots import Catalogue, Robot
from armlab.content.variants import Value
from armlab.errors import suggestion

if TYPE_CHECKING:
    from markdown_it.token import Token

TABLES = ("start", "check", "question", "solution")
"""TOML blocks; at most one of each in a step."""

TEXTS = ("hint", "reveal")
"""Markdown blocks; a step may have any number of hints."""

CODE = ("", "python", "text", "toml")
"""Languages of fenced blocks that are shown unchanged."""


@dataclass(frozen=True)
class Setting:
    """The data that all steps of a lesson share.

    Attributes
    ----------
    file : str
    before : int
        Lines of the file before the Markdown.
    robot : Robot
    catalogue : Catalogue
    values : mapping of str to Value
        Values of the variant.
    drawn : bool
        Whether they were drawn: it is another variant than 0.
    prose : Prose
    """

    file: str
    before: int
    robot: Robot
    catalogue: Catalogue
    values: Mapping[str, Value]
    drawn: bool
    prose: Prose

    def line(self, token: Token) -> int:
        """Return the line of a block in the file, from 1."""
        return self.before + (token.map[0] if token.map else 0) + 1


class Start(NamedTuple):
    """Start of a step: the example put in place, the actions after it, and the panel that opens."""

    example: str = ""
    panel: str = ""
    begin: tuple[Action, ...] = ()


def sections_of(tokens: list[Token]) -> list[list[Token]]:
    """Return the blocks before the first heading of level 2, then the blocks from each such heading on."""
    sections: list[list[Token]] = [[]]
    for token in tokens:
        if token.type == "heading_open" and token.tag == "h2" and token.level == 0:
            sections.append([])
        sections[-1].append(token)
    return sections


def read_step(setting: Setting, number: int, section: list[Token]) -> Step:
    """Read a section.

    Parameters
    ----------
    setting : Setting
    number : int
        Number of the step, from 1.
    section : list of Token
        The section with its heading.

    Raises
    ------
    LessonError
    """
    where, prose = f"step {number}", setting.prose.anew()
    _, title, _, *blocks = section
    text, found = _sorted(setting, where, blocks)
    line = setting.line(section[0])
    if not title.content.strip():
        raise LessonError(setting.file, where, "expected a title after ##", line)
    if any(child.type == "live" for child in title.children or ()):
        raise LessonError(setting.file, where, "expected a title without live values", line)
    reader = _Blocks(setting, where, prose, found)
    start, check, question = reader.start(), reader.check(), reader.question()
    if found["reveal"] and check is None and question is None:
        block = found["reveal"][0]
        problem = "expected a check or a question in the step, after which it is shown"
        raise LessonError(setting.file, f"{where}.reveal", problem, setting.line(block))
    return Step(
        title=title.content,
        line=line,
        example=start.example,
        panel=start.panel,
        begin=start.begin,
        html=prose.html(text, where, setting.before),
        check=check,
        question=question,
        hints=reader.texts("hint"),
        reveal_html="".join(reader.texts("reveal")),
        solution=reader.solution(),
        live=prose.used,
    )


def _sorted(setting: Setting, where: str, blocks: list[Token]) -> tuple[list[Token], dict[str, list[Token]]]:
    """Return the text of a step, and its fenced blocks by name."""
    found: dict[str, list[Token]] = {name: [] for name in (*TABLES, *TEXTS)}
    text = []
    for token in blocks:
        name = token.info.strip() if token.type == "fence" else ""
        refuse_swallowed(setting, where, token)
        if name in found:
            if found[name] and name != "hint":
                problem = "expected one in a step; begin another step with '## Title'"
                raise LessonError(setting.file, f"{where}.{name}", problem, setting.line(token))
            found[name].append(token)
        elif name in CODE:
            text.append(token)
        else:
            problem = f"unknown block {name!r}{suggestion(name, (*found, *CODE[1:]))}"
            raise LessonError(setting.file, where, problem, setting.line(token))
    return text, found


def refuse_swallowed(setting: Setting, where: str, token: Token) -> None:
    """Refuse a fenced block that has no end, or in which another block or step begins: Markdown would take it for text.

    A block that is shown on purpose stands between longer fences, and a heading that is shown in a block of code.

    Raises
    ------
    LessonError
        With the line of the outer block.
    """
    begins = _swallowed(token) if token.type == "fence" else ""
    if begins:
        name = token.info.strip()
        at = f"{where}.{name}" if name in (*TABLES, *TEXTS) else where
        raise LessonError(setting.file, at, f"{begins}; is its closing {token.markup} missing?", setting.line(token))


def _swallowed(token: Token) -> str:
    """Return what shows that the end of a fenced block is missing; empty where nothing does."""
    for line in token.content.split("\n"):
        inner = line.strip().removeprefix(token.markup).strip()
        if inner != line.strip() and inner in (*TABLES, *TEXTS):
            return f"a block {inner!r} begins inside this one"
    if not _is_closed(token):
        return "the block goes on to the end of the file"
    if token.info.strip() in TEXTS and "\n## " in f"\n{token.content}":
        section = next(iter(sections_of(tokens_of(token.content))[1:]), None)
        return "" if section is None else f"the step {section[1].content!r} begins inside this one"
    return ""


def _is_closed(token: Token) -> bool:
    """Return whether a fenced block has a line at its end besides the first one and those of its content."""
    first, end = token.map or (0, 0)
    within = token.content.count("\n") + (token.content[-1:] not in ("", "\n"))
    return end - first == within + 2


def _read_start(table: Table, robot: Robot) -> Start:
    """Take ``example``, ``panel`` and tables ``do``, at least one of them."""
    example = example_name(table, "example") if table.has("example") else ""
    start = Start(example, table.text("panel", ""), read_begin(table, robot))
    if start == Start():
        raise table.fail("example", "missing; expected example, panel or tables [[do]]")
    table.done()
    return start


@dataclass(frozen=True)
class _Blocks:
    setting: Setting
    where: str
    prose: Prose
    found: dict[str, list[Token]]

    def start(self) -> Start:
        if not self.found["start"]:
            return Start()
        with self._located("start"):
            start = _read_start(self._table("start"), self.setting.robot)
            return start._replace(begin=placed(start.begin, self._padded(self.found["start"][0])))

    def check(self) -> StateCheck | None:
        if not self.found["check"]:
            return None
        with self._located("check"):
            return read_state_check(self._table("check"), self.setting.robot, self.prose.of_table)

    def question(self) -> Question | None:
        if not self.found["question"]:
            return None
        with self._located("question"):
            return read_question(self._table("question"), self.prose.of_table, self.setting.drawn)

    def solution(self) -> tuple[Action, ...]:
        if not self.found["solution"]:
            return ()
        with self._located("solution"):
            done = read_solution(self._table("solution"), self.setting.robot, self.setting.catalogue)
            return placed(done, self._padded(self.found["solution"][0]))

    def texts(self, name: str) -> tuple[str, ...]:
        where = f"{self.where}.{name}"
        return tuple(self.prose.block(token, where, self.setting.before) for token in self.found[name])

    def _located(self, name: str) -> AbstractContextManager[None]:
        token = self.found[name][0]
        return located(self.setting.file, f"{self.where}.{name}", self._padded(token), self.setting.line(token))

    def _padded(self, token: Token) -> str:
        return "\n" * self.setting.line(token) + token.content

    def _table(self, name: str) -> Table:
        """Return the table of a block, with the values of the variant."""
        file, where = self.setting.file, f"{self.where}.{name}"
        table = Fields.parse(file, self._padded(self.found[name][0]))
        minus = "-" if name in ("solution", "start") else "\u2212"
        return Table(file, filled_data(table.data, self.setting.values, file, where, minus), where)
