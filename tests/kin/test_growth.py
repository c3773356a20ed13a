"""Compound growth: the number of the notes, each of four numbers from the others, and what is refused."""

import math
import random

import pytest

from armlab.errors import InputError
from armlab.kin.growth import doubling_time, grown, growth_rate, years_to_grow


def test_the_rate_of_half_a_century(truth):
    case = truth["C1.8-cagr-1973-2024"]
    given = case["inputs"]
    rate = growth_rate(given["V_begin"], given["V_end"], given["years"])
    assert rate == pytest.approx(case["expected"]["cagr"], abs=case["tol"])


def test_each_of_the_four_numbers_follows_from_the_others():
    rng = random.Random(0)
    for _ in range(300):
        begin, rate, years = 10.0 ** rng.uniform(-3, 9), rng.uniform(-0.6, 1.5), rng.uniform(0.1, 60.0)
        end = grown(begin, rate, years)
        assert growth_rate(begin, end, years) == pytest.approx(rate, rel=1e-9, abs=1e-12)
        assert grown(end, rate, -years) == pytest.approx(begin, rel=1e-9)
        assert years_to_grow(begin, end, rate) == pytest.approx(years, rel=1e-6)
        assert grown(begin, rate, doubling_time(rate)) == pytest.approx(begin * (2.0 if rate > 0 else 0.5), rel=1e-9)


def test_growth_is_compound_and_not_a_sum():
    assert grown(1.0, 0.1, 2.0) == pytest.approx(1.21, rel=1e-12)
    # Every year 7 % are not five times 7 % in five years.
    assert grown(1.0, 0.07, 5.0) - 1.0 == pytest.approx(0.402552, abs=1e-6)


def test_tiny_rates_keep_their_digits():
    assert growth_rate(1.0, 1.0 + 1e-12, 1.0) == pytest.approx(1e-12, rel=1e-3)
    assert doubling_time(0.0) == math.inf
    assert years_to_grow(5.0, 5.0, 0.0) == 0.0


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: growth_rate(0.0, 1.0, 1.0), "begin: expected a number above zero, got 0"),
        (lambda: growth_rate(1.0, -1.0, 1.0), "end: expected a number above zero, got -1"),
        (lambda: growth_rate(1.0, 2.0, 0.0), "years: expected a number that is not zero"),
        (lambda: growth_rate(1.0, 2.0, 1e-9), "at a rate beyond all numbers"),
        (lambda: grown(1.0, -1.0, 1.0), "rate: expected more than -100 % a year, got -100 %"),
        (lambda: grown(1.0, 10.0, 1e6), "beyond all numbers"),
        (lambda: years_to_grow(1.0, 2.0, 0.0), "with 0 % a year 1 never becomes 2"),
        (lambda: doubling_time(math.nan), "rate: expected"),
    ],
)
def test_what_cannot_be_computed_is_refused_in_words(call, told):
    with pytest.raises(InputError, match=told):
        call()
