"""Equations of a derivation evaluated as they are written: a judge that reads the LaTeX."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np

from armlab.kin.ik.by_hand import Line, Step


def evaluated(line: Line, step: Step) -> tuple[Any, Any, bool] | None:
    """Return both sides of an equation as numbers, and whether they are angles; None when it has no quantity."""
    if "<" not in line.right:
        return None
    values = {name: _number(one.value) for name, one in step.values.items()}
    text = line.right
    if not line.left:
        left, right = text.split("=")
        return _value(left, values, step), _value(right, values, step), False
    return values[line.left], _value(text, values, step), step.values[line.left].unit == "rad"


def _number(value: float | tuple[float, ...]) -> Any:
    return np.array(value) if isinstance(value, tuple) else value


def _value(text: str, values: dict[str, Any], step: Step) -> Any:
    for name, function in (("sin", "sin"), ("cos", "cos")):
        text = re.sub(rf"\\{name}<(\w+)>", rf"{function}(<\1>)", text)
        text = re.sub(rf"\\,\\{name}\\theta_1", f"*{function}(theta)", text)

    text = text.replace(r"\mathrm{atan2}", "atan2").replace(r",\,", ",")
    text = re.sub(r"\\,\(", "*vector(", text).replace(r"\,", "*").replace(r"\cdot", "*" if "frac" in text else "@")
    while r"\frac{" in text:
        text = _fraction(text)
    while r"\sqrt{" in text:
        at = text.index(r"\sqrt{")
        inside, rest = _braces(text[at + 5 :])
        text = f"{text[:at]}sqrt({inside}){rest}"
    text = text.replace("^2", "**2")
    text = re.sub(r"<sign>\s*", "sign*", text)
    text = re.sub(r"<(\w+)>", r"v['\1']", text)
    assert "\\" not in text, text
    names = {
        "v": values,
        "sign": step.sign,
        "theta": values.get("theta", math.nan),
        "sqrt": lambda x: math.sqrt(max(0.0, x)),
        "sin": math.sin,
        "cos": math.cos,
        "atan2": math.atan2,
        "vector": lambda *parts: np.array(parts),
    }
    return eval(text, {"__builtins__": {}}, names)


def _fraction(text: str) -> str:
    at = text.index(r"\frac{")
    above, rest = _braces(text[at + 5 :])
    below, rest = _braces(rest)
    return f"{text[:at]}(({above})/({below})){rest}"


def _braces(text: str) -> tuple[str, str]:
    """Return what stands in the braces a text begins with, and the rest."""
    depth = 0
    for i, letter in enumerate(text):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if depth == 0:
            return text[1:i], text[i + 1 :]
    raise AssertionError(text)
