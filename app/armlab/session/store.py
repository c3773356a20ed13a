"""Sessions by token, saved on disk: they survive a reload, a lost network and a restart."""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import os
import tempfile
import threading
import time
from collections.abc import Callable, Collection
from pathlib import Path

from armlab.content.robots import Robot
from armlab.session.salvage import Lost, salvaged, told
from armlab.session.session import Session
from armlab.session.share import state_of_parts
from armlab.session.state import Json, Part, State
from armlab.session.weight import weight

log = logging.getLogger(__name__)

FORMAT = 1

IDLE = 120.0
"""Time, seconds, after the last visit of a student before the session may be dropped from memory."""

OPENING = 30.0
"""Time, seconds, after the last visit during which the page may still be under construction."""

MOST_IDLE = 200
"""Largest number of sessions in memory without a page; others are read again from their files."""

MOST_HELD = 256 << 20
"""Largest size of the undo steps of all students, bytes."""

MOST_UNSEEN = 64 << 20
"""Largest size, bytes, of the present states of students without a page: results of long work are large, and can be
computed again."""

KEPT = ".kept"
"""Ending of files that could not be read."""

NOT_RESTORED = "Not restored"
"""Heading of what is told of work that is lost."""

UNREADABLE = (
    "Your saved work cannot be read or does not fit this version of the lab; this is a fresh start. The old file is "
    "kept beside the others: whoever runs the lab finds it by the name {name}."
)

MOST_TEXT = 16 << 10
"""Largest length of the text of a part that is kept for the next time it is written, characters."""

MOST_FILES = 20_000
"""Largest number of students whose work is kept, the latest visitors; a number, as clocks may be wrong."""


def _refused(number: str) -> float:
    raise ValueError(f"expected finite numbers, got {number}")


class Store:
    """Live sessions, and one small file for each.

    Parameters
    ----------
    folder : Path or None
        Folder of the files; None keeps everything in memory only.
    opening : Robot
        The arm a new student begins with.
    """

    def __init__(self, folder: Path | None, opening: Robot) -> None:
        self._folder, self.opening = folder, opening
        self._live: dict[str, Session] = {}
        self._visited: dict[str, float] = {}  # longest ago first
        self._saved: dict[str, State] = {}
        self._texts: dict[str, dict[str, tuple[Part, str]]] = {}
        self._weights: dict[str, tuple[State, int]] = {}
        self._failing: dict[str, str] = {}
        self._unread: set[str] = set()
        self._lock, self._saving = threading.Lock(), threading.Lock()
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            _clear_up(folder)

    def get(self, token: str) -> Session:
        """Return the session of a browser: from memory, from disk, or new."""
        with self._lock:
            self._visited.pop(token, None)
            self._visited[token] = time.monotonic()
            if token not in self._live:
                self._live[token] = self._load(token)
            return self._live[token]

    def let_go(self, watched: Collection[str], now: float) -> None:
        """Keep within the allowed memory: of sessions without a page, and of steps of undo.

        Parameters
        ----------
        watched : collection of str
            Tokens of the students who have a page open.
        now : float
            Seconds of the monotonic clock.
        """
        heavy = self._heavy(watched)
        with self._lock:
            idle = [token for token, at in self._visited.items() if token not in watched and now - at > IDLE]
            # Without a folder nothing comes back.
            least = IDLE if self._folder is None else OPENING
            too_heavy = [token for token in heavy if now - self._visited[token] > least]
            for token in dict.fromkeys((*idle[: max(0, len(idle) - MOST_IDLE)], *too_heavy)):
                if self._folder is None or self._is_saved(token):
                    del self._live[token], self._visited[token]
                    self._saved.pop(token, None)
                    self._texts.pop(token, None)
            histories = [session.history for session in self._live.values()]
        while sum(history.held for history in histories) > MOST_HELD:
            max(histories, key=lambda history: history.held).forget_half()

    def _heavy(self, watched: Collection[str]) -> list[str]:
        """Return the tokens to drop so that states of students without a page stay below the allowed size."""
        with self._lock:
            states = {token: self._live[token].state for token in self._visited if token not in watched}
        known, self._weights = self._weights, {}
        for token, state in states.items():
            before = known.get(token)
            self._weights[token] = before if before and before[0] is state else (state, weight(state))
        over = sum(held for _, held in self._weights.values()) - MOST_UNSEEN
        going = []
        for token, (_, held) in self._weights.items():
            if over <= 0:
                break
            going.append(token)
            over -= held
        return going

    def save(self) -> int:
        """Write the sessions whose state has changed since the last time; return how many were written.

        Each file is replaced as a whole, so a crash leaves the old or the new one, never a half. One that cannot be
        written is tried again the next time and holds up no other.
        """
        if self._folder is None:
            return 0
        with self._saving:  # an older state must not be written over a newer one
            with self._lock:
                changed = [(t, s.state) for t, s in self._live.items() if not self._is_saved(t)]
            return sum([self._save_one(token, state) for token, state in changed])

    def _is_saved(self, token: str) -> bool:
        """Return whether the file of a live session holds its state; what windows show is no reason to write one."""
        saved, state = self._saved.get(token), self._live[token].state
        return saved is state or (saved is not None and state.holds_the_same(saved))

    def _save_one(self, token: str, state: State) -> bool:
        try:
            self._write(token, self._text(token, state))
        except Exception as error:
            # A full disk fails for everybody every second: the log needs to hear of it once.
            if repr(error) not in self._failing.values():
                log.exception("a session cannot be saved")
            self._failing[token] = repr(error)
            return False
        self._failing.pop(token, None)
        self._saved[token] = state
        return True

    def _path(self, token: str) -> Path:
        """Return the file of a token, whose name is not the token itself."""
        assert self._folder is not None
        return self._folder / f"{hashlib.sha256(token.encode()).hexdigest()[:40]}.json"

    def _text(self, token: str, state: State) -> str:
        """Return the text of the file of a state: a hand that drags changes two parts of eighty."""
        known, texts = self._texts.get(token, {}), {}
        for part in state:
            if part.saved:
                kept = known.get(part.key)
                texts[part.key] = kept if kept and kept[0] is part else (part, json.dumps(part.to_json()))
        self._texts[token] = {key: kept for key, kept in texts.items() if len(kept[1]) <= MOST_TEXT}
        parts = ", ".join(f"{json.dumps(key)}: {text}" for key, (_, text) in texts.items())
        return f'{{"format": {FORMAT}, "parts": {{{parts}}}}}'

    def _write(self, token: str, text: str) -> None:
        handle, temporary = tempfile.mkstemp(dir=self._folder, prefix=".writing-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            if token in self._unread:
                self._keep(token)
            os.replace(temporary, self._path(token))
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise

    def _keep(self, token: str) -> None:
        """Put a file that could not be read aside: what is in it may be wanted once it can be read."""
        path = self._path(token)
        with contextlib.suppress(FileNotFoundError):
            os.replace(path, path.with_suffix(f".{path.stat().st_mtime_ns}{KEPT}"))
        self._unread.discard(token)

    def _load(self, token: str) -> Session:
        session = Session.fresh(token, self.opening)
        self._saved[token] = session.state
        if self._folder is None:
            return session
        path = self._path(token)
        try:
            session.state, lost = _read(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return session
        except Exception as error:
            # Nobody can list what a damaged file may raise, and it must not keep its student out.
            self._unread.add(token)
            log.warning("the session %s is not usable, and is kept: %r", path.stem, error)
            session.tell(UNREADABLE.format(name=path.stem[:8]), heading=NOT_RESTORED)
            return session
        if lost:
            # It is saved without them the next time, so that the student is told once.
            self._unread.add(token)
            _tell_of_lost(session, path.stem, lost)
        else:
            self._unread.discard(token)
            self._saved[token] = session.state
        return session


def state_from_text(text: str) -> State:
    """Return the state in a saved file; raises an error when anything does not fit."""
    return state_of_parts(_parts_in(text))


def _read(text: str) -> tuple[State, Lost]:
    """Return the state in a saved file, and what of it could not be read; raises an error when nothing can be."""
    try:
        return state_from_text(text), {}
    except Exception:
        return salvaged(_parts_in(text, numbers=float))


def _parts_in(text: str, numbers: Callable[[str], float] = _refused) -> Json:
    data = json.loads(text, parse_constant=numbers)
    if data["format"] != FORMAT:
        raise ValueError(f"format {data['format']}, expected {FORMAT}")
    return data["parts"]


def _tell_of_lost(session: Session, name: str, lost: Lost) -> None:
    """Tell the log and the student which parts of a file, which is kept, could not be read."""
    for kind, reason in lost.items():
        log.warning("the session %s is kept: its part %r is not usable, and begins anew: %s", name, kind.key, reason)
    if words := told(lost):
        session.tell(words, heading=NOT_RESTORED)


def _clear_up(folder: Path) -> None:
    """Remove unfinished files of a killed process, and the oldest files when there are too many."""
    kept = [sorted(folder.glob(f"*{ending}"), key=lambda path: path.stat().st_mtime) for ending in (".json", KEPT)]
    too_many = (path for paths in kept for path in paths[: max(0, len(paths) - MOST_FILES)])
    for path in (*folder.glob(".writing-*"), *too_many):
        try:
            path.unlink()
        except OSError as error:
            log.warning("%s cannot be cleared up: %s", path.name, error.strerror)
