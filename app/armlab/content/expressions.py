"""Formulas as people type them: ``2 l1 cos(q1) + sqrt(2)/2``. A small parser; nothing is ever executed."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from typing import NoReturn, TypeVar

from armlab.content.fold import Fold
from armlab.content.formula_tokens import END, Known, Token, tokens_of
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError, suggestion

T = TypeVar("T")

LONGEST = 600
"""Longest expression, in characters."""

DEEPEST = 40
"""Deepest nesting of brackets, functions, signs and powers."""

LARGEST_POWER = 1000.0
"""Largest exponent, in magnitude."""

FUNCTIONS: dict[str, tuple[Callable[..., float], int, int]] = {
    "sqrt": (math.sqrt, 1, 1),
    "exp": (math.exp, 1, 1),
    "ln": (math.log, 1, 1),
    "sin": (math.sin, 1, 1),
    "cos": (math.cos, 1, 1),
    "tan": (math.tan, 1, 1),
    "asin": (math.asin, 1, 1),
    "acos": (math.acos, 1, 1),
    "atan": (math.atan, 1, 1),
    "atan2": (math.atan2, 2, 2),
    "abs": (abs, 1, 1),
    "min": (min, 2, 8),
    "max": (max, 2, 8),
    "rad": (math.radians, 1, 1),
    "deg": (math.degrees, 1, 1),
}
"""Functions by name, with the least and largest number of arguments. Angles are in radians; rad converts degrees."""

MORE_FUNCTIONS: dict[str, tuple[Callable[..., float], int, int]] = {
    "sec": (lambda x: 1.0 / math.cos(x), 1, 1),
    "csc": (lambda x: 1.0 / math.sin(x), 1, 1),
    "cot": (lambda x: math.cos(x) / math.sin(x), 1, 1),
    "sinh": (math.sinh, 1, 1),
    "cosh": (math.cosh, 1, 1),
    "tanh": (math.tanh, 1, 1),
    "arg": (lambda x: math.atan2(0.0, x), 1, 1),
    "conj": (lambda x: x, 1, 1),
    "re": (lambda x: x, 1, 1),
    "im": (lambda x: 0.0, 1, 1),
}
"""Functions that `parse` takes where they are named, likewise; what they are of complex numbers is in `identity`."""

RESERVED = frozenset({*FUNCTIONS, "pi"})
"""Names that no variable may have."""

IN_DEGREES = {"sin": "sin of degrees", "cos": "cos of degrees", "tan": "tan of degrees"}
"""Replacements for `Expression.with_functions` that give the result of a calculator set to degrees."""


def _power(base: float, exponent: float) -> float:
    if abs(exponent) > LARGEST_POWER:
        raise InputError(f"a power of {exponent:g} is too large; at most {LARGEST_POWER:g}")
    return math.pow(base, exponent)


OPERATIONS: dict[str, Callable[..., float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "^": _power,
    "minus": lambda a: -a,
    "sin of degrees": lambda a: math.sin(math.radians(a)),
    "cos of degrees": lambda a: math.cos(math.radians(a)),
    "tan of degrees": lambda a: math.tan(math.radians(a)),
    **{name: function for name, (function, _, _) in (FUNCTIONS | MORE_FUNCTIONS).items()},
}
"""Operations and functions by name."""


@dataclass(frozen=True)
class _Node:
    """A number, a name, or an operation on other nodes."""

    operation: str = ""
    arguments: tuple[_Node, ...] = ()
    number: float = 0.0
    name: str = ""

    def value(self, values: Mapping[str, float]) -> float:
        if self.operation:
            result = OPERATIONS[self.operation](*(node.value(values) for node in self.arguments))
            return float(result)
        if self.name:
            if self.name not in values:
                raise InputError(f"no value for {self.name!r}{suggestion(self.name, values)}")
            return float(values[self.name])
        return self.number

    def folded(self, fold: Fold[T]) -> T:
        if self.operation:
            return fold.operation(self.operation, [node.folded(fold) for node in self.arguments])
        return fold.name(self.name) if self.name else fold.number(self.number)

    def with_functions(self, others: Mapping[str, str]) -> _Node:
        if not self.operation:
            return self
        arguments = tuple(node.with_functions(others) for node in self.arguments)
        return replace(self, operation=others.get(self.operation, self.operation), arguments=arguments)


@dataclass(frozen=True)
class Expression:
    """A formula that has been read.

    Attributes
    ----------
    text : str
        The text as typed.
    names : frozenset of str
        The variables in it.
    """

    text: str
    names: frozenset[str]
    _root: _Node

    def value(self, values: Mapping[str, float]) -> float:
        """Return its value; angles are in radians.

        Raises
        ------
        InputError
            A division by zero, a root or arc of a number that has none, a result that is not finite, no value for a
            name.
        """
        try:
            found = self._root.value(values)
        except ZeroDivisionError:
            raise InputError(f"{self._cut}: division by zero") from None
        except OverflowError:
            raise InputError(f"{self._cut}: the result is too large") from None
        except ValueError as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{self._cut}: not a real number, such as the root of a negative one or ln 0") from None
        if not math.isfinite(found):
            raise InputError(f"{self._cut}: the result is not finite")
        return found

    def folded(self, fold: Fold[T]) -> T:
        """Return what a fold makes of the formula, such as its values at many points, or how it is printed."""
        return self._root.folded(fold)

    def with_functions(self, others: Mapping[str, str]) -> Expression:
        """Return the formula with some functions in place of others, such as ``{"sin": "cos", "cos": "sin"}``."""
        return replace(self, _root=self._root.with_functions(others))

    @property
    def _cut(self) -> str:
        return repr(self.text if len(self.text) <= 40 else self.text[:37] + "...")


def parse(
    text: str, names: Collection[str] = (), functions: Collection[str] = tuple(FUNCTIONS), together: bool = True
) -> Expression:
    """Read a formula of numbers, pi, names, + - * / ^, brackets and functions.

    A product may leave out its sign, as in ``2 l1 cos(q1)`` or ``l1c12``; it is then evaluated from left to right like
    any other. ``°`` or ``deg`` after a factor turns degrees into radians; ``rad`` changes nothing there.

    Parameters
    ----------
    text : str
    names : collection of str
        The variables that may stand in it.
    functions : collection of str
        Those of `FUNCTIONS` and `MORE_FUNCTIONS` that are allowed.
    together : bool
        Whether names may also stand together without a space, as ``l1c12``.

    Raises
    ------
    InputError
        Anything else; the text says what was expected, and which names there are.

    Examples
    --------
    >>> parse("2 l1 cos(q1) + 1", ["l1", "q1"]).value({"l1": 3.0, "q1": 0.0})
    7.0
    """
    if not isinstance(text, str) or not text.strip():
        raise InputError("expected a formula or a number, got nothing")
    source = plain_symbols(text).strip() if len(text) <= LONGEST else text
    if len(source) > LONGEST:
        raise InputError(f"expected a formula of at most {LONGEST} characters, got {len(source)}")
    reader = _Reader(tokens_of(source, Known(names, functions, together)))
    root = reader.sum()
    if reader.token != END:
        reader.fail()
    return Expression(text, frozenset(reader.names), root)


class _Reader:
    """A recursive descent parser: a sum of products of powers of factors."""

    def __init__(self, tokens: list[Token]) -> None:
        self._tokens, self._place, self._depth = [*tokens, END], 0, 0
        self.names: set[str] = set()

    @property
    def token(self) -> Token:
        """The next token."""
        return self._tokens[self._place]

    def fail(self) -> NoReturn:
        """Raise the error for an unexpected token."""
        if self.token is END:
            raise InputError("the formula breaks off: expected a number, a name or a bracket at its end")
        before = self._tokens[self._place - 1].text if self._place else ""
        after = self._tokens[self._place + 1].text
        if self.token.text == "," and before.isdecimal() and after.isdecimal():
            raise InputError(f"a decimal number is written with a point: {before}.{after}, not {before},{after}")
        raise InputError(f"{self.token.text!r} cannot stand {f'after {before!r}' if before else 'at the beginning'}")

    def sum(self) -> _Node:
        """Read terms with + and -."""
        left = self._product()
        while self._at("+", "-"):
            left = _Node(self._take(), (left, self._product()))
        return left

    def _product(self) -> _Node:
        left = self._signed()
        while True:
            if self._at("*", "/"):
                left = _Node(self._take(), (left, self._signed()))
            elif self.token.kind in ("name", "function") or self._at("("):
                left = _Node("*", (left, self._raised()))
            else:
                return left

    def _signed(self) -> _Node:
        if not self._at("+", "-"):
            return self._raised()
        sign = self._take()
        operand = self._deeper(self._signed)
        return _Node("minus", (operand,)) if sign == "-" else operand

    def _raised(self) -> _Node:
        base = self._factor()
        if self._at("°", "rad"):
            base = _Node("rad", (base,)) if self._take() == "°" else base
        if not self._at("^"):
            return base
        self._take()
        return _Node("^", (base, self._deeper(self._signed)))

    def _factor(self) -> _Node:
        token = self.token
        if token.kind == "number":
            self._take()
            return _Node(number=float(token.text))
        if token.kind == "name":
            self._take()
            if token.text == "pi":
                return _Node(number=math.pi)
            self.names.add(token.text)
            return _Node(name=token.text)
        if token.kind == "function":
            return self._call()
        if not self._at("("):
            self.fail()
        self._take()
        inside = self._deeper(self.sum)
        self._close()
        return inside

    def _call(self) -> _Node:
        function = self._take()
        if self._at("^"):
            raise InputError(
                f"write {function}(...)^2 for the power of {function}: the power stands behind the bracket"
            )
        if not self._at("("):
            raise InputError(f"expected a bracket after {function}, as in {function}(q1)")
        self._take()
        arguments = [self._deeper(self.sum)]
        while self._at(","):
            self._take()
            arguments.append(self._deeper(self.sum))
        self._close()
        _, fewest, most = (FUNCTIONS | MORE_FUNCTIONS)[function]
        if not fewest <= len(arguments) <= most:
            expected = f"{fewest}" if fewest == most else f"{fewest} to {most}"
            values = "one value" if most == 1 else f"{expected} values"
            raise InputError(f"{function} takes {values} in its brackets, got {len(arguments)}")
        return _Node(function, tuple(arguments))

    def _close(self) -> None:
        if self.token is END:
            raise InputError("a bracket is not closed")
        if not self._at(")"):
            self.fail()
        self._take()

    def _at(self, *signs: str) -> bool:
        return self.token.kind == "sign" and self.token.text in signs

    def _take(self) -> str:
        self._place += 1
        return self._tokens[self._place - 1].text

    def _deeper(self, read: Callable[[], _Node]) -> _Node:
        self._depth += 1
        if self._depth > DEEPEST:
            raise InputError(f"brackets and signs are nested too deep; at most {DEEPEST}")
        node = read()
        self._depth -= 1
        return node
