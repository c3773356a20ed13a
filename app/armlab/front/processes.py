"""Lab processes of a class: started, watched and ended by the front's process."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import IO

from armlab.errors import ArmlabError


class LabProcesses:
    """Several labs on loopback.

    A lab reads its standard input and ends when it closes, so no lab outlives its front, not even one that was killed.
    It is started in a process group of its own: Ctrl-C reaches the front alone, which then ends the labs in order.
    """

    def __init__(
        self, count: int, opening: str, sessions: Path | None, secret: str, lessons: Sequence[Path] = ()
    ) -> None:
        folders = [str(folder.resolve()) for folder in lessons]
        said = {"opening": opening, "sessions": sessions and str(sessions), "secret": secret, "lessons": folders}
        settings = json.dumps(said)
        self._processes = [self._launch(settings) for _ in range(count)]
        self.ports = [self._port(process) for process in self._processes]

    def _launch(self, settings: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "armlab.front.lab_process"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self._pipe(process.stdin).write(settings + "\n")
        self._pipe(process.stdin).flush()
        return process

    def _port(self, process: subprocess.Popen[str]) -> int:
        line = self._pipe(process.stdout).readline()
        if not line:
            self.stop()
            raise ArmlabError("a lab process could not be started; its message is above")
        return int(json.loads(line)["port"])

    @staticmethod
    def _pipe(pipe: IO[str] | None) -> IO[str]:
        assert pipe is not None
        return pipe

    def stop(self) -> None:
        """End all labs; they save before they go."""
        for process in self._processes:
            self._pipe(process.stdin).close()
        for process in self._processes:
            try:
                process.wait(5.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            self._pipe(process.stdout).close()
