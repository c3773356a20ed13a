"""The examples in docstrings give what stands below them, but for the last digits of numbers."""

import doctest
import importlib
import math
import re

import pytest

from support.sources import PACKAGE, files_with

NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\w])")
ROUNDING = 1e-12
"""Relative difference up to which two numbers are one: processors and libraries round differently."""
NOTHING = 1e-14
"""Size up to which a number is zero, such as the cosine of a right angle."""


class Rounded(doctest.OutputChecker):
    """A comparison of two texts in which numbers may differ by rounding."""

    def check_output(self, want, got, optionflags):
        if super().check_output(want, got, optionflags):
            return True
        pairs = [NUMBER.findall(text) for text in (want, got)]
        if len(pairs[0]) != len(pairs[1]) or NUMBER.sub("#", want).split() != NUMBER.sub("#", got).split():
            return False
        return all(
            math.isclose(float(ours), float(theirs), rel_tol=ROUNDING, abs_tol=NOTHING)
            for ours, theirs in zip(*pairs, strict=True)
        )


def modules_with_examples():
    """Return the names of the modules in whose docstrings there are examples."""
    files = files_with(sorted(PACKAGE.rglob("*.py")), r">>> ")
    names = (".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts) for file in files)
    return [name.removesuffix(".__init__") for name in names]


def failures(module, said=None):
    """Return how many examples of a module there are, and how many of them fail."""
    runner = doctest.DocTestRunner(Rounded(), optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder(exclude_empty=True).find(module):
        runner.run(test, out=said)
    return runner.tries, runner.failures


@pytest.mark.parametrize("name", modules_with_examples())
def test_examples_give_what_is_printed(name):
    said = []
    tried, failed = failures(importlib.import_module(name), said.append)
    assert tried > 0, "the examples are not found"
    assert failed == 0, "".join(said)


@pytest.mark.parametrize(
    ("printed", "same"),
    [
        ("[0.3, -1.0]", True),
        ("[0.30000000000000004, -1.0]", True),
        ("[0.3, -1.000000001]", False),
        ("[0.3]", False),
        ("[0.3, -1.0, 2.0]", False),
        ("(0.3, -1.0)", False),
        ("[0.3, 1.0]", False),
    ],
)
def test_only_rounding_is_forgiven(printed, same):
    assert Rounded().check_output("[0.3, -1.0]\n", f"{printed}\n", 0) == same
