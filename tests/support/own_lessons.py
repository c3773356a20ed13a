"""Lessons that are only for tests, and how a student comes into them."""

from __future__ import annotations

import html
import json
import urllib.request
from pathlib import Path
from typing import Any

from support.fake_browser import FakeBrowser, cookie_of
from support.student import student

PWN = "<script>window.__pwned=1</script><img src=x onerror='window.__pwned=1'>"
"""What must be shown as the text it is."""

ARM = 'robot = "planar_2r"\nq_deg = [30, 60]\npanel = "joints"\n'

QUESTIONS = """
The introduction.

## One of three

Joint 1 is at {{q1}}.

```question
kind = "choice"
text = "How many joints?"
options = ["one", "two **joints**", "three"]
answer = 2

[[wrong]]
answer = 1
says = "Count *again*."
```

```hint
Look at the arm.
```

```hint
More than one.
```

```reveal
Two it is.
```

## Several of four

```question
kind = "choice"
text = "Which are even?"
options = ["1", "2", "3", "4"]
answer = [2, 4]

[[wrong]]
answer = 3
says = "Three is odd."
```

## A matrix

```question
kind = "matrix"
text = "The identity, halved?"
answer = [[0.5, 0], [0, 0.5]]
tolerance = 0.001
```

## A formula

```question
kind = "expression"
text = "$p_x$?"
answer = "l1*cos(q1) + l2*cos(q1 + q2)"
variables = ["l1", "l2", "q1", "q2"]

[[wrong]]
answer = "l1*cos(q1) + l2*cos(q2)"
says = "The second link turns with the first."
```

## Predict

Where is the hand at $q = 0$? It is at {{px}}.

```question
kind = "number"
text = "How large is $p_x$ for $q = 0$?"
answer = 2
unit = "m"
tolerance = 0.01
hide = ["arm", "values"]
```

```reveal
Both links in a line.
```

## Stretch it

```check
kind = "tool_at"
position = [2, 0, 0]
tolerance_m = 0.05

[[wrong]]
kind = "joint_at"
joint = 1
value_deg = 0
tolerance_deg = 2
says = "The *second* joint is left."
q_deg = [0, 55]
```

```hint
Both at zero.
```

```solution
q_deg = [0, 0]
```
"""

HOSTILE = f"""
Introduction {PWN}

## Step {PWN}

Text {PWN}

```question
kind = "choice"
text = "Question {PWN}"
options = ["Option {PWN}", "right"]
answer = 2

[[wrong]]
answer = 1
says = "Says {PWN}"
```

```hint
Hint {PWN}
```

```reveal
Reveal {PWN}
```
"""

HOSTILE_ARM = f"""
[arm]
name = "Arm {PWN}"
convention = "standard"
task = "xy"

[[arm.joints]]
type = "R"
a = 1
limits_deg = [-180, 180]

[[arm.joints]]
type = "R"
a = 1
limits_deg = [-180, 180]
"""


def lesson(body: str = "\n## One\n\nText.\n", front: str = ARM, title: str = "Of a test") -> str:
    """Return the text of a lesson file."""
    return f'+++\ntitle = "{title}"\nchapter = "0 Tests"\nteaches = ["S4.0-2R"]\n{front}+++\n{body}'


def write(folder: Path, **texts: str) -> Path:
    """Write lessons by key into a folder, and return it."""
    for key, text in texts.items():
        (folder / f"{key}.md").write_text(text, encoding="utf-8")
    return folder


def load(url: str, cookie: str, path: str) -> None:
    """Load a page as a browser does that has the cookie already."""
    urllib.request.urlopen(urllib.request.Request(url + path, headers={"Cookie": cookie})).close()


async def in_lesson(url: str, place: str, cookie: str | None = None) -> FakeBrowser:
    """Come into a lesson by its link, with all its dock there."""
    cookie = cookie or cookie_of(url)
    load(url, cookie, f"lesson/{place}")
    browser = await student(url, cookie, f"/lesson/{place}")
    await browser.until(lambda: "lesson-text" in browser.html() and "lesson-foot" in browser.html())
    return browser


async def to_step(browser: FakeBrowser, step: int) -> None:
    """Go to a step, from 1."""
    await browser.press(f"lesson-step-{step - 1}")
    await browser.until(lambda: f"<small>{step} of " in browser.html())


def piece(browser: FakeBrowser, marker: str) -> str:
    """Return the one piece of markup with something in it; empty when there is none."""
    contents = (c["props"].get("content", "") for c in browser.controls.values())
    return next((content for content in contents if marker in content), "")


def notes(browser: FakeBrowser) -> dict[str, Any]:
    """Return what the page's script is told."""
    text = piece(browser, "al-notes").split('data-notes="', 1)[1].split('"', 1)[0]
    found: dict[str, Any] = json.loads(html.unescape(text))
    return found
