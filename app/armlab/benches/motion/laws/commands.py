"""Commands of the bench of timing laws."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.bounds import joint_paths
from armlab.benches.motion.laws.state import MOST_LAWS, Laws
from armlab.benches.motion.laws.timing import AS_TYPED, Entry, smoothness
from armlab.errors import InputError
from armlab.kin.motion import free_law_types, law_type
from armlab.kin.motion.breaks import SMOOTH_ENOUGH
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.scaling import Scaling, optimal_scaling
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import setting
from armlab.session.state import Command, State


@dataclass(frozen=True)
class AddLaw(Command):
    """Add a law beside the others: the first kind that is not shown yet."""

    label: ClassVar[str] = "timing law"

    def apply(self, state: State) -> State:
        """Return the state with one more law."""
        part = state[Laws]
        if len(part.entries) == MOST_LAWS:
            raise InputError(f"at most {MOST_LAWS} laws are shown at once: remove one first")
        there = {entry.chosen.key for entry in part.entries}
        colour = min(set(range(MOST_LAWS)) - {entry.colour for entry in part.entries})
        for key in (key for key in free_law_types() if key not in there):
            try:
                return _with(state, entries=(*part.entries, Entry(Chosen(key), colour=colour)))
            except InputError:
                # This kind needs a limit that is not given; another does not.
                continue
        raise InputError("no other law can be made with this duration and these limits")


@dataclass(frozen=True)
class RemoveLaw(Command):
    """Remove a law."""

    place: int
    label: ClassVar[str] = "timing law"

    def apply(self, state: State) -> State:
        """Return the state without the law."""
        part = state[Laws]
        entry = _entry(part, self.place)
        if len(part.entries) == 1:
            raise InputError("the last law cannot be removed; choose another one in its place")
        entries = tuple(each for each in part.entries if each is not entry)
        scaled = part.scaled - (part.scaled > self.place)
        return _with(state, entries=entries, scaled=min(scaled, len(entries) - 1))


@dataclass(frozen=True)
class ChooseLaw(Command):
    """Choose another kind for a law, with its options at their defaults."""

    place: int
    key: str
    label: ClassVar[str] = "timing law"

    def apply(self, state: State) -> State:
        """Return the state with the kind chosen."""
        entry = _entry(state[Laws], self.place)
        if entry.chosen.key == self.key:
            return state
        return _with_entry(state, self.place, Entry(Chosen.of(free_law_types(), self.key), colour=entry.colour))


@dataclass(frozen=True)
class SetLawOption(Command):
    """Set an option of a law; None restores its default."""

    place: int
    name: str
    value: Any
    label: ClassVar[str] = "option of a timing law"

    def apply(self, state: State) -> State:
        """Return the state with the option set."""
        entry = _entry(state[Laws], self.place)
        chosen = entry.chosen.with_option(law_type(entry.chosen.key), self.name, self.value)
        return _with_entry(state, self.place, replace(entry, chosen=chosen))


@dataclass(frozen=True)
class LeaveAsTyped(Command):
    """Leave a law as its options define it, or stretch it to the duration and the distance."""

    place: int
    on: bool
    label: ClassVar[str] = "law as typed"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        entry = _entry(state[Laws], self.place)
        known_name("law with a time of its own", entry.chosen.key, AS_TYPED)
        return _with_entry(state, self.place, replace(entry, as_typed=self.on))


@dataclass(frozen=True)
class AsFastAsAllowed(Command):
    """Choose whether the laws are as fast as the limits allow, or last for the duration."""

    on: bool
    label: ClassVar[str] = "timing"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        return _with(state, timing=replace(state[Laws].timing, fastest=self.on))


@dataclass(frozen=True)
class SetQuantity(Command):
    """Set duration, distance or a limit; None removes a limit."""

    name: str
    value: float | None
    label: ClassVar[str] = "duration or limit"

    def apply(self, state: State) -> State:
        """Return the state with the quantity set."""
        return _with(state, timing=state[Laws].timing.with_quantity(self.name, self.value))


@dataclass(frozen=True)
class Stretch(Command):
    """Stretch the chosen law to k times its time; sent by a slider in motion."""

    k: float
    snapshot: ClassVar[bool] = True
    rests: ClassVar[bool] = True
    label: ClassVar[str] = "time scaling"

    def apply(self, state: State) -> State:
        """Return the state with the factor set."""
        return _with(state, k=float(self.k))


@dataclass(frozen=True)
class StretchOptimally(Command):
    """Stretch or shrink the chosen law until it meets one of the limits."""

    label: ClassVar[str] = "optimal time scaling"

    def apply(self, state: State) -> State:
        """Return the state with the optimal factor."""
        k = optimal(state[Laws]).k
        return _with(state, k=1.0 if math.isclose(k, 1.0, rel_tol=1e-9) else k)


@dataclass(frozen=True)
class SetBound(Command):
    """Set knots, limits or speed of the calculator; None restores a default."""

    name: str
    value: Any
    label: ClassVar[str] = "bounds on a path"

    def apply(self, state: State) -> State:
        """Return the state with the value set."""
        return _with(state, bounded=state[Laws].bounded.with_value(self.name, self.value))


@dataclass(frozen=True)
class ChooseBoundPath(Command):
    """Choose another kind of path through the knots of the calculator."""

    key: str
    label: ClassVar[str] = "path of the bounds"

    def apply(self, state: State) -> State:
        """Return the state with the path chosen."""
        bounded = state[Laws].bounded
        if bounded.path.key == self.key:
            return state
        return _with(state, bounded=replace(bounded, path=Chosen.of(joint_paths(), self.key)))


@dataclass(frozen=True)
class SetBoundOption(Command):
    """Set an option of the path of the calculator; None restores its default."""

    name: str
    value: Any
    label: ClassVar[str] = "path of the bounds"

    def apply(self, state: State) -> State:
        """Return the state with the option set."""
        bounded = state[Laws].bounded
        path = bounded.path.with_option(joint_paths()[bounded.path.key], self.name, self.value)
        return _with(state, bounded=replace(bounded, path=path))


@dataclass(frozen=True)
class LowerSpeed(Command):
    """Lower V of the calculator so that some acceleration is left."""

    label: ClassVar[str] = "lowered speed"

    def apply(self, state: State) -> State:
        """Return the state with the lower speed."""
        bounded = state[Laws].bounded
        return _with(state, bounded=replace(bounded, speed=bounded.found.lowered().V))


@dataclass(frozen=True)
class TakeBounds(Command):
    """Use V and A of the calculator as limits of laws from 0 to 1, as fast as allowed."""

    label: ClassVar[str] = "limits from a path"

    def apply(self, state: State) -> State:
        """Return the state with these limits."""
        part = state[Laws]
        bounds = part.bounded.found
        if not bounds.possible:
            raise InputError(f"A: {bounds.A:.4g} 1/s² leaves no acceleration; lower V first")
        acceleration = float(bounds.A) if part.bounded.a_max else part.timing.acceleration
        timing = replace(part.timing, fastest=True).with_quantity("distance", 1.0)
        timing = timing.with_quantity("speed", float(bounds.V)).with_quantity("acceleration", acceleration)
        return _with(state, timing=timing)


def optimal(part: Laws) -> Scaling:
    """Return the factor with which the chosen law meets one of V, A and J; J is used only if the jerk is finite.

    Raises
    ------
    InputError
        No limit holds it back; the text names them.

    References
    ----------
    Notes 6.161-6.163.
    """
    entry, law, timing = part.entries[part.scaled], part.laws[part.scaled], part.timing
    jerk = law.peak_jerk if smoothness(entry, law) >= SMOOTH_ENOUGH else 0.0
    limits = [timing.limit(order) for order in (1, 2, 3)]
    held = (
        peak
        for peak, limit in zip((law.peak_speed, law.peak_acceleration, jerk), limits, strict=True)
        if limit < math.inf
    )
    if not any(held):
        raise InputError("V, A, J: no limit is given that this law could reach, so no k is optimal")
    return optimal_scaling(Limits(*limits), law.peak_speed, law.peak_acceleration, jerk)


def _entry(part: Laws, place: int) -> Entry:
    refuse_beyond(place, len(part.entries), "law")
    return part.entries[place]


def _with(state: State, **fields: object) -> State:
    return setting(state, Laws, fields)


def _with_entry(state: State, place: int, entry: Entry) -> State:
    entries = state[Laws].entries
    return _with(state, entries=(*entries[:place], entry, *entries[place + 1 :]))
