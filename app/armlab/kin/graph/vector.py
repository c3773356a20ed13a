"""Three-vectors and small matrices of expressions."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from armlab.kin.graph.expression import Number

Vector = tuple[Number, Number, Number]
Matrix = Sequence[Sequence[Number]]


def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def combine(s: Number, a: Vector, t: Number, b: Vector) -> Vector:
    """Return s a + t b."""
    return (s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2])


def along(point: Vector, distance: Number, direction: Vector) -> Vector:
    """Return point + distance * direction."""
    return add(point, combine(distance, direction, 0.0, direction))


def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    """Return the scalar product of two equally long sequences."""
    total: Number = 0.0
    for x, y in zip(a, b, strict=True):
        total = total + x * y
    return total


def maximal_minors(matrix: Matrix) -> list[Number]:
    """Return all m x m minors of an m x n matrix, m <= n, columns in lexicographic order.

    Laplace expansion row by row; minors of the lower rows are shared between the columns that need them.
    """
    rows, columns = len(matrix), len(matrix[0])
    known: dict[tuple[int, tuple[int, ...]], Number] = {}

    def minor(row: int, chosen: tuple[int, ...]) -> Number:
        if row == rows:
            return 1.0
        if (row, chosen) not in known:
            total: Number = 0.0
            for position, column in enumerate(chosen):
                entry = matrix[row][column]
                if isinstance(entry, float) and entry == 0.0:
                    continue
                term = entry * minor(row + 1, chosen[:position] + chosen[position + 1 :])
                total = total - term if position % 2 else total + term
            known[row, chosen] = total
        return known[row, chosen]

    return [minor(0, chosen) for chosen in combinations(range(columns), rows)]


def transpose(matrix: Matrix) -> list[list[Number]]:
    """Return the transposed matrix."""
    return [list(column) for column in zip(*matrix, strict=True)]


def solve_symmetric(matrix: Matrix, right: Sequence[Number]) -> list[Number]:
    """Solve A x = b for a symmetric positive definite A by A = L D L^T, without square roots.

    Works on expressions and on plain floats alike.
    """
    n = len(right)
    A = [list(row) for row in matrix]
    L: list[list[Number]] = [[0.0] * n for _ in range(n)]
    inverse_D: list[Number] = []
    for k in range(n):
        inverse_D.append(1.0 / A[k][k])
        for i in range(k + 1, n):
            L[i][k] = A[i][k] * inverse_D[k]
        for i in range(k + 1, n):
            for j in range(k + 1, i + 1):
                A[i][j] = A[j][i] = A[i][j] - L[i][k] * A[j][k]
    x = list(right)
    for i in range(n):
        for k in range(i):
            x[i] = x[i] - L[i][k] * x[k]
    x = [value * inverse for value, inverse in zip(x, inverse_D, strict=True)]
    for i in reversed(range(n)):
        for k in range(i + 1, n):
            x[i] = x[i] - L[k][i] * x[k]
    return x
