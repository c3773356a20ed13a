"""Numbers of products and sums in a change of coordinates, against the operations that are really written down."""

import itertools

import pytest

from armlab.errors import InputError
from armlab.kin.graph.expression import Graph, live_nodes
from armlab.kin.graph.vector import dot
from armlab.kin.operations import COSTS, Count, multiplied_first, one_by_one, worth_multiplying


def test_the_numbers_of_the_notes(truth):
    expected = truth["C3.1-opcount"]["expected"]
    for found, listed in ((multiplied_first(3), "matrix_first"), (one_by_one(3), "vector_chain")):
        assert {"mul": found.products, "add": found.sums} == expected[listed]


def counted(graph, outputs):
    kinds = [graph.nodes[index][0] for index in live_nodes(graph, outputs)]
    return Count(kinds.count("mul"), kinds.count("add") + kinds.count("sub"))


class Rows:
    """Symbolic matrices of a kind: rotations, or 3 x 4 blocks above a last row that is known."""

    def __init__(self, kind):
        self.kind, self.graph, self._next = kind, Graph(), itertools.count()

    def symbols(self, rows, columns):
        return [[self.graph.variable(next(self._next)) for _ in range(columns)] for _ in range(rows)]

    def matrix(self):
        return {"rotation": (3, 3), "transform": (3, 4), "whole": (4, 4)}[self.kind]

    def point(self):
        return self.symbols(4 if self.kind == "whole" else 3, 1)

    def product(self, A, B):
        """Return A B; the last column of a transform is a point."""
        if self.kind != "transform":
            return [[dot(row, column) for column in zip(*B, strict=True)] for row in A]
        turned = [[dot(row[:3], column) for column in zip(*B, strict=True)] for row in A]
        return [[*line[:-1], line[-1] + row[3]] for line, row in zip(turned, A, strict=True)]


@pytest.mark.parametrize("kind", COSTS)
@pytest.mark.parametrize(("steps", "points"), [(1, 1), (2, 1), (4, 1), (3, 2)])
def test_counts_are_those_of_the_written_products(kind, steps, points):
    rows = Rows(kind)
    given = [rows.symbols(*rows.matrix()) for _ in range(steps)]
    places = [rows.point() for _ in range(points)]
    whole = given[0]
    for matrix in given[1:]:
        whole = rows.product(whole, matrix)
    outputs = [line[0] for p in places for line in rows.product(whole, p)]
    assert multiplied_first(steps, points, kind) == counted(rows.graph, outputs)
    outputs = []
    for p in places:
        for matrix in reversed(given):
            p = rows.product(matrix, p)
        outputs += [line[0] for line in p]
    assert one_by_one(steps, points, kind) == counted(rows.graph, outputs)


@pytest.mark.parametrize("kind", COSTS)
@pytest.mark.parametrize("steps", [2, 3, 7])
def test_from_so_many_points_on_multiplying_first_takes_fewer_products(kind, steps):
    enough = worth_multiplying(kind)
    assert multiplied_first(steps, enough, kind).products < one_by_one(steps, enough, kind).products
    assert multiplied_first(steps, enough - 1, kind).products >= one_by_one(steps, enough - 1, kind).products


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: multiplied_first(0), "steps: expected a whole number, at least 1, got 0"),
        (lambda: one_by_one(2, -1), "points: expected a whole number, at least 0, got -1"),
        (lambda: one_by_one(2, 1, "quaternion"), "kind: unknown name 'quaternion'"),
    ],
)
def test_what_cannot_be_counted_is_refused_in_words(call, told):
    with pytest.raises(InputError, match=told):
        call()
