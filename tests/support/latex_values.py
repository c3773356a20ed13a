"""Numbers of formulas in LaTeX, so that a formula can be compared with what the core computes."""

import math
import re

GIVEN = {"sqrt": math.sqrt, "atan2": math.atan2, "pi": math.pi}

_TOKEN = re.compile(r"\*\*|\\?[A-Za-z]+@\w+|\\[A-Za-z]+2?|[A-Za-z]|\d+|[-+*/(),]")


def value(tex, **names):
    """Return the value of a formula of names, roots, fractions and powers; ``c_theta`` stands for c with an index."""
    return eval(python_of(tex), {**GIVEN, **names})


def right_side(formula, name):
    """Return the right side of the first formula of an entry that begins with a name."""
    return next(tex.partition("=")[2] for tex in formula.tex if tex.partition("=")[0].strip() == name)


def matrix(formula, **names):
    """Return the values of the only matrix of an entry."""
    (inside,) = re.findall(r"\\begin\{bmatrix\}(.*?)\\end\{bmatrix\}", "".join(t for t in formula.tex if "s_" in t))
    return [[value(entry, **names) for entry in row.split("&")] for row in inside.split(r"\\")]


def python_of(tex):
    r"""Return a formula as Python writes it.

    >>> python_of(r"\frac{a\,c_{12}}{2\tau^2}")
    '((a*c_12)/(2*tau**(2)))'
    """
    tex = re.sub(r"\\left|\\right|\\[;,]", " ", tex)
    tex = re.sub(r"\\[td]frac", r"\\frac", re.sub(r"\\text\{(\w+)\}", r"\\\1", tex))
    tex = re.sub(r"([A-Za-z])_(?:\{(\w[\w+]*)\}|\\([a-z]+)|(\w))", _indexed, tex)
    before = ""
    while tex != before:
        before = tex
        tex = re.sub(r"\^(?:\{([^{}]*)\}|(\w))", r"**(\1\2)", tex)
        tex = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", tex)
        tex = re.sub(r"\\sqrt\{([^{}]*)\}", r"\\sqrt(\1)", tex)
    tokens = [token.lstrip("\\").replace("@", "_") for token in _TOKEN.findall(tex)]
    return "".join(_between(left, right) + right for left, right in zip(["", *tokens], tokens, strict=False))


def _indexed(found):
    return f" {found[1]}@{(found[2] or found[3] or found[4]).replace('+', 'p')} "


def _between(left, right):
    """Return the sign of a product where LaTeX writes none."""
    ends = left == ")" or left[-1:].isalnum()
    begins = right == "(" or right[:1].isalnum()
    return "*" if ends and begins and left not in ("sqrt", "atan2") else ""
