"""The state of one student: frozen parts, one for each topic.

A part holds inputs only; what follows from it is a `cached_property` of the part, and what follows from several parts
is asked for with `State.derived`. Both are computed once a change and only when somebody looks. A new bench brings a
new part, in ``state.py`` of its folder, and touches no other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any, ClassVar, Self, TypeVar

from armlab.content.robots import Robot
from armlab.plugins import discover_in_benches

PARTS = ("armlab.session.parts", "armlab.teaching.parts")
"""Names of the packages with parts that belong to no page: they are walked, as benches are."""

Json = Any
"""Data that `json.dumps` takes."""


@dataclass(frozen=True)
class Stand:
    """A place at which a student works, with a history of its own.

    Parameters
    ----------
    name : str
    passing : str
        Tells apart those whose history ends when they are left; empty for the others.
    """

    name: str
    passing: str = ""


class Part:
    """A part of the state. Subclasses are frozen dataclasses and are defined in ``state.py`` of a bench."""

    key: ClassVar[str]

    kept_by_undo: ClassVar[bool] = False
    """Whether undo leaves the part as it is: what is shown is not work that is taken back."""

    looks_at_undo: ClassVar[bool] = False
    """Whether a part that undo leaves as it is reacts to what an undo has brought, as it does to a command."""

    saved: ClassVar[bool] = True
    """Whether files and links hold the part; one that is of the moment only is not looked for there either."""

    called: ClassVar[str] = ""
    """Name for a person of a part that belongs to no page; empty where nobody misses it."""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part as it is when an arm has just been chosen."""
        raise NotImplementedError

    def for_robot(self, robot: Robot) -> Self:
        """Return the part for another arm; by default the initial one."""
        return self.initial(robot)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Return the part for the same arm with an edited table.

        Parameters
        ----------
        robot : Robot
        origin : tuple of int or None
            For each joint of the edited arm, its index before; None for an added one.
        """
        return self.for_robot(robot)

    def after(self, before: State, now: State) -> Self:
        """Return the part adapted to the changes of other parts by a command; called once for each command."""
        return self

    @property
    def opened(self) -> str:
        """Name of the thing that is open, such as a lesson; a window is told when another one has switched it."""
        return ""

    @property
    def bench(self) -> str:
        """Key of the panel that the part brings to the front of a new window; empty for none."""
        return ""

    @property
    def hidden(self) -> frozenset[str]:
        """Keys of the panels that the part hides."""
        return frozenset()

    @property
    def stand(self) -> Stand | None:
        """The place at which the student works by the part; None where it knows of none."""
        return None

    def begun(self, token: str) -> Self:
        """Return the part, as it is at first, for a new student with a token; by default it is the same for all."""
        return self

    def refuse_forgetting(self) -> None:
        """Raise `InputError` where a student who starts fresh would lose what must not be lost."""

    def waiting_at(self, stand: str) -> State | None:
        """Return the state that waits at another place while the student stands here; None for none."""
        return None

    def for_undo(self, found: State) -> State:
        """Return a state that undo has found without what held in it by this part, and does not hold any more."""
        return found

    def rewound(self, clip: str) -> Self:
        """Return the part with its film at the start, if the film with this key is its own and open."""
        return self

    def guard(self, before: State, now: State) -> None:
        """Raise `InputError` to refuse a change that a command or an undo is about to make in other parts."""

    def to_json(self) -> Json:
        """Return the part as JSON."""
        raise NotImplementedError

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; raise any error when the data are not usable."""
        raise NotImplementedError

    @classmethod
    def with_states(cls, data: Json, change: Callable[[Json], Json]) -> Json:
        """Return the JSON of a part with the parts of each state that it holds changed; by default it holds none."""
        return data


P = TypeVar("P", bound=Part)
T = TypeVar("T")


@dataclass(frozen=True)
class PartType:
    """The constant ``PART`` of a module of parts.

    Parameters
    ----------
    part : type
        The class.
    order : int
        Reactions (`Part.after`) run in this order.
    """

    part: type[Part]
    order: int

    @property
    def key(self) -> str:
        """The key of the part's class."""
        return self.part.key


@cache
def part_types() -> tuple[type[Part], ...]:
    """Return all parts, in order."""
    return tuple(found.part for found in discover_in_benches("state", "PART", PartType, *PARTS).values())


class State:
    """An immutable set of parts, one of each type: ``state[Joints].q``.

    Attributes
    ----------
    at : float
        Time of the state, or of the command that is applied to it, in seconds of the session's clock; not saved.
    """

    def __init__(self, parts: Iterable[Part], at: float = 0.0, kinds: _Kinds | None = None) -> None:
        self._parts, self.at = tuple(parts), at
        self._kinds = _kinds_of(tuple(map(type, self._parts))) if kinds is None else kinds
        self._derived: dict[Callable[[State], Any], Any] = {}

    @classmethod
    def initial(cls, robot: Robot) -> State:
        """Return the state in which an arm opens."""
        return cls(_initial_parts(robot))

    @classmethod
    def begun(cls, robot: Robot, token: str) -> State:
        """Return the first state of a new student; see `Part.begun`."""
        return cls(part.begun(token) for part in _initial_parts(robot))

    def with_own(self, name: str) -> list[Part]:
        """Return, in order, the parts whose class has something of its own under a name of `Part`."""
        return [self._parts[place] for place in self._kinds.with_own(name)]

    def __getitem__(self, kind: type[P]) -> P:
        part: Any = self._parts[self._kinds.places[kind]]
        found: P = part
        return found

    def __iter__(self) -> Iterator[Part]:
        return iter(self._parts)

    def holds_the_same(self, other: State) -> bool:
        """Return whether a file of another state would be a file of this one."""
        pairs = zip(self._parts, other._parts, strict=False)
        return self._kinds is other._kinds and all(mine is its for mine, its in pairs if mine.saved)

    def replace(self, *parts: Part) -> State:
        """Return the state with these parts in place of the present ones of their types."""
        changed = list(self._parts)
        for part in parts:
            changed[self._kinds.places[type(part)]] = part
        return State(changed, self.at, self._kinds)

    def dated(self, at: float) -> State:
        """Return the same state with another time."""
        state = State(self._parts, at, self._kinds)
        state._derived = self._derived
        return state

    def with_robot(self, robot: Robot) -> State:
        """Return the state with every part adapted to another arm."""
        return State((part.for_robot(robot) for part in self), self.at)

    def with_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> State:
        """Return the state with every part adapted to an edited table of the same arm; see `Part.for_edited`."""
        return State((part.for_edited(robot, origin) for part in self), self.at)

    def derived(self, compute: Callable[[State], T]) -> T:
        """Return ``compute(state)``, computed at most once for this state."""
        known = self._derived  # another thread may have all of it forgotten meanwhile
        if compute not in known:
            known[compute] = compute(self)
        value: T = known[compute]
        return value

    def forget_derived(self) -> None:
        """Forget results of `derived`; they are computed again when needed."""
        self._derived = {}

    def to_json(self) -> Json:
        """Return the whole state as JSON, part by part, without what is not saved."""
        return {part.key: part.to_json() for part in self if part.saved}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> State:
        """Return a state from JSON; a missing part is as it opens with this arm."""
        return cls(
            kind.from_json(data[kind.key], robot) if kind.saved and kind.key in data else kind.initial(robot)
            for kind in part_types()
        )


@lru_cache(maxsize=4)
def _initial_parts(robot: Robot) -> tuple[Part, ...]:
    """Return the parts with which an arm opens, one set for all students who have changed none of them."""
    return tuple(kind.initial(robot) for kind in part_types())


class _Kinds:
    """The types of the parts of a state, kept once for all states that have them: each step of undo is one.

    Attributes
    ----------
    places : dict of type to int
        Where the part of each type stands.
    """

    def __init__(self, kinds: tuple[type[Part], ...]) -> None:
        self.places = {kind: place for place, kind in enumerate(kinds)}
        self._own: dict[str, tuple[int, ...]] = {}

    def with_own(self, name: str) -> tuple[int, ...]:
        """Return where the parts stand that have something of their own under a name of `Part`."""
        found = self._own.get(name)
        if found is None:
            theirs = getattr(Part, name)
            found = tuple(place for kind, place in self.places.items() if getattr(kind, name) is not theirs)
            self._own[name] = found
        return found


@cache
def _kinds_of(kinds: tuple[type[Part], ...]) -> _Kinds:
    return _Kinds(kinds)


class Command:
    """A request to change the state. Subclasses are frozen dataclasses beside the part they change.

    Attributes
    ----------
    snapshot : bool
        Whether, of commands of one `channel` waiting in a row, only the newest counts (a drag, a moving slider);
        otherwise all are applied in order.
    rests : bool
        Whether a pause ends its stroke: sliders do not say when they are let go.
    undoable : bool
        Whether it is a step of undo; what only changes the view of things is none.
    label : str
        Name of the change that an undo takes back.
    reacts : bool
        Whether parts guard against it and react to it; a whole state that is put in place fits together already.
    places : mapping of str to tuple of str
        Names of what an argument counts from 0, where a number from 1 does not tell a person which one it is; an empty
        tuple of an argument that counts from 1 already.
    units : mapping of str to str
        Units of arguments as files write them, where they are not those that their names tell: ``value_deg``.
    """

    snapshot: ClassVar[bool] = False
    rests: ClassVar[bool] = False
    undoable: ClassVar[bool] = True
    label: ClassVar[str] = "change"
    reacts: ClassVar[bool] = True
    places: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    units: ClassVar[Mapping[str, str]] = {}

    def apply(self, state: State) -> State:
        """Return the new state. Pure: no clock but `State.at`, no randomness, no I/O. Raise `ArmlabError` to refuse."""
        raise NotImplementedError

    def asked_in(self, window: int) -> Command:
        """Return what it is when a person has asked for it in a window; what turns pages turns those of this one."""
        return self

    def ends_history(self, before: State, after: State) -> bool:
        """Return whether steps before it cannot be taken back any more: it has put something in place for good."""
        return False

    @property
    def channel(self) -> object:
        """A key of snapshots that replace each other."""
        return type(self)

    def instead_of(self, waiting: Command) -> Command:
        """Return what counts of this snapshot and one of its channel that waits: this, the newer one."""
        return self

    @property
    def stroke(self) -> object:
        """A key of successive commands that are one step of undo; None for a step of its own.

        A whole move of a slider is one step.
        """
        return self.channel if self.rests else None


Post = Callable[[Command], None]
"""A function that hands a command to the worker and returns at once."""


def apply(state: State, command: Command, at: float = 0.0) -> State:
    """Return the state after a command and after the reactions of the parts to it.

    Parameters
    ----------
    state : State
    command : Command
    at : float
        Seconds of the session's clock, since 1970 where dates matter.

    Raises
    ------
    ArmlabError
        The command, or a part that guards the state, refuses.
    TypeError
        A second command stands in place of the time; it would not be applied.
    """
    if isinstance(at, Command):
        raise TypeError(f"one command is applied at a time; {type(at).__name__} stands in place of the time")
    dated = state.dated(at)
    changed = command.apply(dated)
    if changed is dated:
        return state
    if not command.reacts:
        return changed.dated(at)
    guard(state, changed)
    changed = changed.dated(at)
    adapted = [(part, part.after(state, changed)) for part in changed.with_own("after")]
    return changed.replace(*(new for part, new in adapted if new is not part))


def guard(before: State, now: State) -> None:
    """Ask every part whether a change is allowed; see `Part.guard`."""
    for part in before.with_own("guard"):
        part.guard(before, now)
