"""The expression graph and its two numeric back-ends."""

import math
import tracemalloc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from armlab.kin.graph.expression import Expression, Graph, absolute, cos, live_nodes, sin, square_root
from armlab.kin.graph.kernel import Kernel
from armlab.kin.graph.scratch import KEPT, Scratch
from armlab.kin.graph.tape import CHUNK, Tape


@pytest.fixture
def graph():
    return Graph()


def test_zero_and_one_fold_away(graph):
    x = graph.variable(0)
    assert x * 0.0 == 0.0
    assert (x + 0.0).same_as(x)
    assert (x * 1.0).same_as(x)
    assert (x * -1.0).same_as(-x)
    assert 0.0 / x == 0.0


def test_equal_sub_expressions_are_one_node(graph):
    x, y = graph.variable(0), graph.variable(1)
    assert (x * y + 2.0).same_as(y * x + 2.0)
    assert (x - y).same_as(-(y - x))


def test_an_expression_minus_itself_is_zero(graph):
    x = sin(graph.variable(0)) * 3.0
    assert x - x == 0.0
    doubled = x + x
    assert doubled.same_as(x * 2.0)


def test_signs_of_sine_and_cosine_come_out(graph):
    x = graph.variable(0)
    assert sin(-x).same_as(-sin(x))
    assert cos(-x).same_as(cos(x))
    assert absolute(-x).same_as(absolute(x))


def test_only_needed_nodes_are_live(graph):
    x, y = graph.variable(0), graph.variable(1)
    sin(y)
    wanted = cos(x) + 1.0
    kinds = [graph.nodes[i][0] for i in live_nodes(graph, [wanted])]
    assert kinds == ["variable", "cos", "add_constant"]


def random_expressions(graph, rng, variables, count):
    """Return expressions that use every operation, most of them several times."""
    pool = [graph.variable(i) for i in range(variables)]
    for _ in range(count):
        a, b = (pool[int(rng.integers(len(pool)))] for _ in range(2))
        c = float(rng.uniform(-2, 2))
        made = [
            a + b,
            a - b,
            a * b,
            a / (b * b + 1.5),
            a + c,
            a * c,
            sin(a),
            cos(a),
            c / (absolute(b) + 0.5),
            square_root(a * a + 0.25),
            square_root(absolute(-a) + 0.1),
        ][int(rng.integers(11))]
        # Bounded, or long products overflow.
        if isinstance(made, Expression):
            pool.append(sin(made) * 1.5)
    return [pool[int(rng.integers(len(pool)))] * float(rng.choice([-1.0, 1.0, 0.5])) for _ in range(7)]


def evaluate(graph, value, x):
    """Evaluate by the definition, recursively."""
    if not isinstance(value, Expression):
        return value
    known = {}

    def node(i):
        if i not in known:
            known[i] = compute(graph.nodes[i])
        return known[i]

    def compute(parts):
        operation, *rest = parts
        if operation == "variable":
            return x[rest[0]]
        a = node(rest[0])
        b = rest[1] if len(rest) > 1 else None
        return {
            "add": lambda: a + node(b),
            "sub": lambda: a - node(b),
            "mul": lambda: a * node(b),
            "div": lambda: a / node(b),
            "add_constant": lambda: a + b,
            "mul_constant": lambda: a * b,
            "constant_over": lambda: b / a,
            "neg": lambda: -a,
            "sin": lambda: math.sin(a),
            "cos": lambda: math.cos(a),
            "sqrt": lambda: math.sqrt(a),
            "abs": lambda: abs(a),
        }[operation]()

    return value.sign * node(value.node)


@pytest.mark.parametrize("seed", range(12))
def test_both_back_ends_agree_with_the_definition(seed):
    rng = np.random.default_rng(seed)
    graph = Graph()
    outputs = [*random_expressions(graph, rng, 4, 60), 0.25, graph.variable(2), -graph.variable(2)]
    kernel = Kernel(graph, outputs, 4)
    x = rng.uniform(-4, 4, (50, 4))
    expected = np.array([[evaluate(graph, o, row) for o in outputs] for row in x])
    np.testing.assert_allclose([kernel.scalar(*row) for row in x.tolist()], expected, rtol=0, atol=1e-12)
    out = np.empty((50, len(outputs)))
    kernel.batch(x, out)
    np.testing.assert_allclose(out, expected, rtol=0, atol=1e-9)
    single = np.empty((50, len(outputs)), np.float32)
    kernel.batch(x.astype(np.float32), single)
    np.testing.assert_allclose(single, expected, rtol=0, atol=2e-3)


@pytest.mark.parametrize("dtype", [float, np.float32])
def test_the_sign_of_what_a_root_is_taken_of_counts(graph, dtype):
    """A graph that meets y first stores x - y as minus (y - x); written anew by half angles it must stay x - y."""
    x, y = graph.variable(0), graph.variable(1)
    kernel = Kernel(graph, [y, square_root(x - y), sin(-square_root(x - y)), absolute(y - x)], 2)
    expected = [1.0, 1.0, -math.sin(1.0), 1.0]
    out = np.empty((1, 4), dtype)
    kernel.batch(np.array([[2.0, 1.0]], dtype), out)
    np.testing.assert_allclose(kernel.scalar(2.0, 1.0), expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose(out[0], expected, rtol=0, atol=1e-6)


def test_the_sign_of_a_negated_root_counts(graph):
    """Under a root a minus is a node of its own; what it negates may have turned its sign on the way."""
    x, y = graph.variable(0), graph.variable(1)
    kernel = Kernel(graph, [y, square_root(-(x - y))], 2)
    out = np.empty((1, 2))
    kernel.batch(np.array([[1.0, 2.0]]), out)
    assert out[0].tolist() == list(kernel.scalar(1.0, 2.0)) == [2.0, 1.0]


def test_batches_longer_than_a_chunk_and_not_its_multiple(graph, rng):
    x = graph.variable(0)
    kernel = Kernel(graph, [sin(x) * cos(x) + 1.0, x], 1)
    values = rng.uniform(-3, 3, (2 * CHUNK + 17, 1))
    out = np.empty((len(values), 2))
    kernel.batch(values, out)
    np.testing.assert_allclose(out[:, 0], np.sin(values[:, 0]) * np.cos(values[:, 0]) + 1.0, atol=1e-15)
    np.testing.assert_array_equal(out[:, 1], values[:, 0])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_difference_wanted_with_either_sign_has_it(graph, dtype):
    x, y, z = (graph.variable(i) for i in range(3))
    both, shared, once = x - y, y - z, z - x
    outputs = [both, -both, -shared, -shared, -once, shared * x]
    out = np.empty((1, 6), dtype)
    Kernel(graph, outputs, 3).batch(np.array([[1.0, 3.0, 7.0]], dtype), out)
    assert out[0].tolist() == [-2.0, 2.0, 4.0, 4.0, -6.0, -4.0]


def test_an_empty_batch_is_an_empty_answer(graph):
    out = np.empty((0, 1))
    Kernel(graph, [sin(graph.variable(0))], 1).batch(np.empty((0, 1)), out)
    assert out.shape == (0, 1)


def test_half_angle_sine_and_cosine_are_exact_to_the_last_digits(graph):
    """Also at pi, where the tangent of the half angle is 1.6e16, and far outside one turn."""
    x = graph.variable(0)
    angles = np.concatenate([np.linspace(-7, 7, 2001), np.pi * np.arange(-9, 10) / 2, np.linspace(-90, 90, 501)])
    out = np.empty((len(angles), 2))
    Kernel(graph, [sin(x), cos(x)], 1).batch(angles[:, None], out)
    np.testing.assert_allclose(out[:, 0], np.sin(angles), rtol=0, atol=5e-16)
    np.testing.assert_allclose(out[:, 1], np.cos(angles), rtol=0, atol=5e-16)


def test_what_other_calls_left_behind_changes_nothing(graph, rng):
    x, y = graph.variable(0), graph.variable(1)
    kernel = Kernel(graph, [sin(x) * y + 0.5, 2.0, cos(x + y)], 2)
    for dtype in (np.float64, np.float32):
        values = rng.uniform(-2, 2, (300, 2)).astype(dtype)
        first, again = np.empty((300, 3), dtype), np.empty((200, 3), dtype)
        kernel.batch(values, first)
        block = KEPT.take(1)
        block[:] = 0xFF
        KEPT.give_back(block)
        kernel.batch(values[:200], again)
        np.testing.assert_array_equal(again, first[:200])


def test_what_one_computes_in_nobody_else_does_until_it_is_given_back():
    scratch = Scratch()
    first, second = scratch.take(100), scratch.take(100)
    assert not np.shares_memory(first, second)
    scratch.give_back(first)
    assert scratch.take(50) is first
    scratch.give_back(second)
    assert len(scratch.take(200)) >= 200


def test_threads_may_compute_at_once(graph, rng):
    x, y = graph.variable(0), graph.variable(1)
    kernel = Kernel(graph, [sin(x * y) + cos(y), x - y * 3.0], 2)
    batches = rng.uniform(-2, 2, (4, 2 * CHUNK + 5, 2))
    alone, found = np.empty((4, 2 * CHUNK + 5, 2)), np.full((4, 2 * CHUNK + 5, 2), np.nan)
    for values, out in zip(batches, alone, strict=True):
        kernel.batch(values, out)
    with ThreadPoolExecutor(4) as threads:
        list(threads.map(kernel.batch, batches, found))
    np.testing.assert_array_equal(found, alone)


def test_a_second_call_asks_for_no_more_memory(graph, rng):
    x, y = graph.variable(0), graph.variable(1)
    kernel = Kernel(graph, [sin(x + y * float(k)) for k in range(1, 40)], 2)
    values, out = rng.uniform(-2, 2, (1000, 2)), np.empty((1000, 39))
    kernel.batch(values, out)
    tracemalloc.start()
    kernel.batch(values, out)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    # Views of some hundred rows, which are as large as NumPy makes them; the rows themselves take as much as `out`.
    assert peak < out.nbytes / 4


def test_registers_are_used_again(graph):
    """A long chain needs only a few scratch columns."""
    x = graph.variable(0)
    value = x
    for k in range(100):
        value = sin(value) + float(k)
    assert Tape(graph, [value], 1, np.dtype(np.float32)).registers <= 2
