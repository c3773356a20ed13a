"""Small lessons for tests, and a library that holds them alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from armlab.content import lessons as library_module
from armlab.content.lessons import Library, changed

TWO_STEPS = """+++
title = "T"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
q_deg = [10, 20]
overlays = ["frames", "trace"]
+++
Intro.
## Read
Only text.
## Same
Move and answer.
```check
kind = "joint_at"
joint = 1
value_deg = 90
tolerance_deg = 1
```
```question
kind = "number"
text = "One and one?"
answer = 2
tolerance = 0.1
```
## Same
```question
kind = "number"
text = "One and two?"
answer = 3
tolerance = 0.1
```
"""

VARIED = """+++
title = "Turn to {{=goal}} degrees"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
q_deg = [0, 20]

[variants]
goal = { from = 30, to = 120, step = 1 }
+++
## Turn
```check
kind = "joint_at"
joint = 1
value_deg = "= goal"
tolerance_deg = 0.4

[[wrong]]
says = "The other way round."
kind = "joint_at"
joint = 1
value_deg = "= -goal"
tolerance_deg = 0.4
q_deg = ["= -goal", 20]
```
```hint
One.
```
```hint
Two.
```
```solution
q_deg = ["= goal", 20]
```
## Predict
```question
kind = "number"
text = "Half of it?"
answer = "= goal/2"
tolerance = 0.1
hide = ["arm", "values"]

[[wrong]]
answer = "= goal"
says = "This is all of it."
```
```reveal
It is {{=goal/2}}.
```
## Double
```question
kind = "number"
text = "Twice?"
answer = "= 2*goal"
tolerance = 0.1
```
"""


def library_fixture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., frozenset[str]]]:
    """Replace the lessons by those of a test; yields a function that writes some or takes them away (None)."""
    folder = tmp_path / "mine"
    folder.mkdir()
    found = Library([folder])
    monkeypatch.setattr(library_module, "library", lambda: found)

    def use(**texts: str | None) -> frozenset[str]:
        # A lab that another test has left open looks at the files, too; who looks first is told what has changed.
        with found._lock:
            for key, text in texts.items():
                path = folder / f"{key}.md"
                # A file of another number: two writes may fall into one tick of the clock of the file system.
                path.unlink(missing_ok=True)
                if text is not None:
                    path.write_text(text, encoding="utf-8")
            return changed()

    use(t=TWO_STEPS, v=VARIED)
    yield use
