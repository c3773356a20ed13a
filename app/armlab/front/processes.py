"""Lab processes of a class, which the process of the front starts, watches and ends."""

from __future__ import annotations

import contextlib
import json
import logging
import subprocess
import sys
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
    """Several labs on loopback; one that dies is started again, and finds its students' work in the folder.

    A lab reads its standard input and ends when it closes, so no lab outlives its front, not even one that was killed.
    It is started in a process group of its own: Ctrl-C reaches the front alone, which then ends the labs in order.

    Attributes
    ----------
    ports : list of int
        Ports of the labs; the entry of a restarted one changes.
    """

    def __init__(
        self,
        count: int,
        opening: str,
        sessions: Path | None,
        secret: str,
        lessons: Sequence[Path] = (),
        teacher_key: str = "",
    ) -> None:
        folders = [str(folder.resolve()) for folder in lessons]
        said = {"opening": opening, "sessions": sessions and str(sessions), "secret": secret, "lessons": folders}
        said["teacher_key"] = teacher_key
        self._settings = json.dumps(said)
        self._stopping = threading.Event()
        self._processes: list[subprocess.Popen[str]] = []
        try:
            for _ in range(count):
                self._processes.append(self._launch())
                self._tell(self._processes[-1])
            self.ports = [self._port(process) for process in self._processes]
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
            self._tell(self._processes[k])
            self.ports[k] = self._port(self._processes[k])
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

    def _tell(self, process: subprocess.Popen[str]) -> None:
        self._pipe(process.stdin).write(self._settings + "\n")
        self._pipe(process.stdin).flush()

    def _port(self, process: subprocess.Popen[str]) -> int:
        line = self._pipe(process.stdout).readline()
        if not line:
            raise ArmlabError("its process has ended; its message is above")
        return int(json.loads(line)["port"])

    @staticmethod
    def _pipe(pipe: IO[str] | None) -> IO[str]:
        assert pipe is not None
        return pipe

    def stop(self) -> None:
        """End all labs; they save first."""
        self._stopping.set()
        self._watcher.join()  # at most until a lab that is being started says its port
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
