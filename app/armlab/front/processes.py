"""Lab processes of a class, which the process of the front starts, watches and ends."""

from __future__ import annotations

import contextlib
import json
import logging
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import IO

from armlab.errors import ArmlabError

log = logging.getLogger(__name__)

LOOK_INTERVAL = 0.25
"""Time, seconds, between two checks whether all labs are running."""

LASTING = 20.0
"""Time, seconds, that a lab has to run to be restarted at once; one that ends sooner waits twice as long each time."""

LONGEST_WAIT = 30.0
"""Longest wait before a restart, seconds."""


class LabProcesses:
    """Several labs; one that dies is started again, and finds its students' work in the folder.

    A lab reads its standard input and ends when it closes, so no lab outlives its front, not even one that was killed.
    It is started in a process group of its own: Ctrl-C reaches the front alone, which then ends the labs in order.

    Attributes
    ----------
    addresses : list of str
        Files at which the labs receive sockets, in a folder of this user alone.
    """

    def __init__(
        self,
        count: int,
        opening: str,
        sessions: Path | None,
        lessons: Sequence[Path] = (),
        teacher_key: str = "",
    ) -> None:
        self._settings = {
            "opening": opening,
            "sessions": sessions and str(sessions),
            "lessons": [str(folder.resolve()) for folder in lessons],
            "teacher_key": teacher_key,
        }
        self._folder = tempfile.TemporaryDirectory(prefix="armlab-")
        self.addresses = [str(Path(self._folder.name, str(k))) for k in range(count)]
        self._stopping = threading.Event()
        self._processes: list[subprocess.Popen[str]] = []
        try:
            for address in self.addresses:
                self._processes.append(self._launch())
                self._tell(self._processes[-1], address)
            for process in self._processes:
                self._wait_for(process)
        except (ArmlabError, OSError):
            self._end()
            raise ArmlabError("a lab process could not be started; its message is above") from None
        self._watcher = threading.Thread(target=self._watch, daemon=True, name="armlab-watcher")
        self._watcher.start()

    def _watch(self) -> None:
        """Restart labs that have ended."""
        began = [time.monotonic()] * len(self._processes)
        waits = [0.0] * len(self._processes)
        while not self._stopping.wait(LOOK_INTERVAL):
            for k, process in enumerate(self._processes):
                now = time.monotonic()
                if process.poll() is None or now < began[k] + waits[k]:
                    continue
                log.error("lab %d has ended (%s) and is started again", k + 1, process.returncode)
                waits[k] = 0.0 if now - began[k] > LASTING else min(LONGEST_WAIT, 2.0 * waits[k] or 1.0)
                began[k] = now
                self._start_again(k)

    def _start_again(self, k: int) -> None:
        with contextlib.suppress(BrokenPipeError):
            self._pipe(self._processes[k].stdin).close()
        self._pipe(self._processes[k].stdout).close()
        try:
            self._processes[k] = self._launch()
            self._tell(self._processes[k], self.addresses[k])
            self._wait_for(self._processes[k])
        except (ArmlabError, OSError) as refusal:
            log.error("lab %d: %s", k + 1, refusal)

    def _launch(self) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-P", "-m", "armlab.front.lab_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def _tell(self, process: subprocess.Popen[str], address: str) -> None:
        self._pipe(process.stdin).write(json.dumps({**self._settings, "address": address}) + "\n")
        self._pipe(process.stdin).flush()

    def _wait_for(self, process: subprocess.Popen[str]) -> None:
        if not self._pipe(process.stdout).readline():
            raise ArmlabError("its process has ended; its message is above")

    @staticmethod
    def _pipe(pipe: IO[str] | None) -> IO[str]:
        assert pipe is not None
        return pipe

    def stop(self) -> None:
        """End all labs; they save first."""
        self._stopping.set()
        self._watcher.join()  # at most until a lab that is being started is open
        self._end()

    def _end(self) -> None:
        for process in self._processes:
            with contextlib.suppress(BrokenPipeError):  # it has not read what it was told
                self._pipe(process.stdin).close()
        for process in self._processes:
            try:
                process.wait(5.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            self._pipe(process.stdout).close()
        self._folder.cleanup()
