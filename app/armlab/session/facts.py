"""Facts that benches publish for lessons to check and show, found by folder: ``velocity.statics.torques``."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, Literal, TypeVar

import numpy as np

from armlab.content.bench_words import is_word
from armlab.content.checks.fact import FactIs
from armlab.content.lesson import Lesson, Step
from armlab.content.observation import Observation
from armlab.content.robots import Robot
from armlab.content.seen_fact import SeenFact, Value, read_value
from armlab.errors import ArmlabError, InputError, UnknownName
from armlab.page import Page
from armlab.plugins import BENCHES, constant_of, discover_in_benches
from armlab.registry import known_name
from armlab.session.job import Job
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import Target
from armlab.session.state import Json, Part, State

T = TypeVar("T")

Kind = Literal["number", "count", "numbers", "text", "truth"]

KINDS: dict[Kind, str] = {
    "number": "a number",
    "count": "a whole number",
    "numbers": "several numbers",
    "text": "a text",
    "truth": "true or false",
}

ANGLES = ("rad", "rad/s")
"""Units of facts whose numbers may be given in degrees in lessons."""


@dataclass(frozen=True)
class Fact:
    """One fact of a bench.

    Parameters
    ----------
    title : str
        The fact in words, to be continued with "is": ``"the largest torque of a joint"``.
    value : callable
        ``value(state)`` returns it, quickly, and None where the arm has no such thing or it is not worked out; an
        `ArmlabError` means the same. A fact of long work only looks at what has been found.
    unit : str
        SI, such as ``"N m"`` or ``"rad"``; empty for none.
    kind : str
        Some of `KINDS`.
    only : str
        Where there is such a thing, for authors; empty where every arm has it.
    names : mapping of str to str
        Of a text that is a key: the words for each, which students are told.
    """

    title: str
    value: Callable[[State], Any]
    unit: str = ""
    kind: Kind = "number"
    only: str = ""
    names: Mapping[str, str] = field(default_factory=dict)

    def now(self, state: State) -> SeenFact:
        """Return the value of the fact in a state."""
        try:
            found = self.value(state)
        except ArmlabError:
            found = None
        return SeenFact(self.title, self.unit, _plain(found), names=self.names)


@dataclass(frozen=True)
class Facts:
    """The constant ``FACTS`` of ``facts.py`` of a page.

    Parameters
    ----------
    module : str
        ``__name__``.
    parts : tuple of type
        Parts of the state from which the facts follow, besides joints and target: they are kept as evidence.
    facts : mapping of str to Fact
        Facts by name; the word of one has the folders of tab and page before it.
    job : Job, optional
        The work that finds them, where it takes long.
    ask : callable, optional
        ``ask(state)`` returns the state in which that work is asked for, where it does not begin by itself.
    """

    module: str
    parts: tuple[type[Part], ...]
    facts: Mapping[str, Fact]
    job: Job | None = None
    ask: Callable[[State], State] | None = None

    @property
    def key(self) -> str:
        """The beginning of their words, such as ``"velocity.statics"``."""
        return self.module.removeprefix(f"{BENCHES}.").rpartition(".")[0]

    @property
    def panel(self) -> str:
        """The key of the page."""
        package = self.module.rpartition(".")[0]
        return constant_of(package, "PAGE", Page).key


def facts_of(found: Callable[[State], T | None]) -> Callable[[Callable[[T], Any]], Callable[[State], Any]]:
    """Return what makes facts of something that a job finds: they are None as long as that is not there.

    Parameters
    ----------
    found : callable
        ``found(state)`` returns it, or None.
    """

    def fact(value: Callable[[T], Any]) -> Callable[[State], Any]:
        def now(state: State) -> Any:
            there = found(state)
            return None if there is None else value(there)

        return now

    return fact


@cache
def facts_of_benches() -> dict[str, Facts]:
    """Return the facts of all benches by page."""
    return discover_in_benches("facts", "FACTS", Facts)


def fact_of(word: str) -> tuple[Facts, Fact]:
    """Return a fact by its word, and those it is among.

    Raises
    ------
    UnknownName
        No such page publishes facts, or it has no such fact; the text lists those there are.
    """
    page, _, name = word.rpartition(".")
    found = facts_of_benches()[known_name("page with facts", page, facts_of_benches())]
    return found, found.facts[known_name(f"fact of {page}", name, found.facts)]


def unfit(asked: FactIs, fact: Fact) -> Iterator[str]:
    """Yield the reasons why a check does not fit its fact."""
    value = asked.value
    of_text, of_truth = isinstance(value, str), isinstance(value, bool)
    several = isinstance(value, tuple)
    kind = "number" if asked.component and fact.kind == "numbers" else fact.kind
    fits = {"text": of_text, "truth": of_truth, "numbers": several}.get(kind, not (of_text or of_truth or several))
    if asked.component and fact.kind != "numbers":
        yield f"it is {KINDS[fact.kind]} and has no components"
    elif not fits and kind == "numbers":
        yield f"it is several numbers, {fact.title}: say which one with component, or give value a list of numbers"
    elif not fits:
        yield f"expected {KINDS[kind]}, for {fact.title}"
    elif kind in ("number", "numbers") and value is not None and not asked.tolerance:
        yield "expected a tolerance above zero: it is no whole number"
    if asked.degrees and fact.unit not in ANGLES:
        yield f"it is no angle, its unit is {fact.unit or 'none'}; write value, at_least, at_most"


def facts_asked(lesson: Lesson, step: Step, met: bool) -> tuple[str, ...]:
    """Return the words of the facts of a step: those in its text, and in its check while that is not met."""
    checked = () if step.check is None or met else step.check.facts
    return tuple(dict.fromkeys((*checked, *filter(is_word, (*step.live, *lesson.live)))))


def benches_of(words: Iterable[str]) -> tuple[Facts, ...]:
    """Return the benches that publish some facts, without repetitions; unknown words are ignored."""
    pages = {word.rpartition(".")[0] for word in words}
    return tuple(found for page, found in facts_of_benches().items() if page in pages) if pages else ()


def seen_facts(state: State, words: Iterable[str]) -> dict[str, SeenFact]:
    """Return the values of facts in a state, by their words; unknown words are ignored."""
    return dict(_seen(state, words))


def _seen(state: State, words: Iterable[str]) -> Iterator[tuple[str, SeenFact]]:
    for word in words:
        try:
            found, fact = fact_of(word)
        except UnknownName:
            continue
        yield word, replace(fact.now(state), slow=found.job is not None)


def worked_out(state: State, found: Facts) -> State:
    """Return the state with the results of the work behind some facts, done at once to its end."""
    if found.job is None:
        return state
    state = found.ask(state) if found.ask else state
    wanted = found.job.wanted(state, frozenset({found.panel}))
    for piece in found.job.run(wanted.inputs) if wanted else ():
        if piece is not None and wanted is not None:
            state = found.job.delivered(state, wanted.inputs, piece)
    return state


def evidence_of(state: State, words: Iterable[str]) -> Json:
    """Return the data from which facts can be computed again, and the values of those that take long."""
    words = tuple(words)
    benches = benches_of(words)
    slow = [word for found in benches if found.job for word in words if word.rpartition(".")[0] == found.key]
    return {
        "parts": {part.key: state[part].to_json() for found in benches for part in found.parts},
        "told": {word: _tellable(seen.value) for word, seen in seen_facts(state, slow).items()},
    }


def _tellable(value: Value | None) -> Json:
    """Return a value as it can be read again; None for other values, or one too large for a file."""
    data = list(value) if isinstance(value, tuple) else value
    try:
        read_value(data, "fact")
    except InputError:
        return None
    return data


def facts_again(data: Json, words: Iterable[str], seen: Observation, robot: Robot, whole: bool) -> dict[str, SeenFact]:
    """Return facts worked out again from evidence, which anyone may have changed.

    Parameters
    ----------
    data : Json
        Data written by `evidence_of`.
    words : iterable of str
    seen : Observation
        The arm, joint values and target, which have been looked at already.
    robot : Robot
        The robot of the lesson.
    whole : bool
        Whether long work is done again; what is told of it is taken down otherwise.

    Raises
    ------
    InputError
        The evidence is not usable.
    """
    words = tuple(words)
    if seen.arm is not robot.arm:
        return {}  # what was done with another arm does not count
    state = _as_it_was(data, words, seen, robot)
    told = data["told"] if isinstance(data, dict) and isinstance(data.get("told"), dict) else {}
    found: dict[str, SeenFact] = {}
    for bench in benches_of(words):
        own = [word for word in words if word.rpartition(".")[0] == bench.key]
        if whole or bench.job is None:
            found |= seen_facts(worked_out(state, bench), own)
        else:
            found |= {
                word: replace(each, value=read_value(told.get(word), f"told.{word}"))
                for word, each in seen_facts(state, own).items()
            }
    return found


def _as_it_was(data: Json, words: tuple[str, ...], seen: Observation, robot: Robot) -> State:
    parts = data.get("parts") if isinstance(data, dict) else None
    if not isinstance(parts, dict):
        raise InputError("facts: what they follow from is missing")
    state = State.initial(robot)
    for kind in {part: None for found in benches_of(words) for part in found.parts}:
        if kind.key not in parts:
            raise InputError(f"facts: the part {kind.key!r} is missing")
        try:
            state = state.replace(kind.from_json(parts[kind.key], robot))
        except Exception as error:
            # Nobody can list what a changed file may raise.
            raise InputError(f"facts: the part {kind.key!r} is not usable: {error}") from error
    joints = replace(Joints.initial(robot).moved_to(seen.q), locked=state[Joints].locked)
    return state.replace(joints, replace(state[Target], pose=seen.target))


def _plain(value: Any) -> Value | None:
    """Return a value without NumPy types; None when it is not a number."""
    if value is None or isinstance(value, (str, bool, np.bool_)):
        return bool(value) if isinstance(value, np.bool_) else value
    if np.ndim(value) == 0:
        return None if math.isnan(value) else float(value)
    numbers = tuple(float(each) for each in np.ravel(value))
    return None if any(map(math.isnan, numbers)) else numbers
