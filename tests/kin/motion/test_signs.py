"""The acceleration of plus and minus one: printed intervals contradict themselves, corrected ones come back to rest."""

import random
from itertools import pairwise

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.signs import ON_8, ON_8_PRINTED, ends_of, pieces, undetermined_share
from armlab.kin.timing.table import PLUS_MINUS_ONE, acceleration_law


def test_the_erratum_leaves_four_tenths_of_the_time_undetermined(truth):
    case = truth["ERR-1.41"]
    found = pieces(*ON_8_PRINTED, 8.0)
    assert undetermined_share(found) == case["printed_value_if_wrong"]["printed_residual"]
    # Both signs are printed from 7/8 to 4.
    both = [(one.start, one.end) for one in found if one.plus and one.minus]
    assert both == [(0.875, 4.0)]
    assert not any(not one.plus and not one.minus for one in found)


def test_the_corrected_intervals_fill_the_time_and_end_at_rest_where_they_began(truth):
    found = pieces(*ON_8, 8.0)
    assert undetermined_share(found) == truth["ERR-1.41"]["expected"]["corrected_residual"] == 0.0
    assert ends_of(found) == (0.0, 0.0)
    assert [(one.start, one.end, one.sign) for one in found] == [tuple(map(float, row)) for row in PLUS_MINUS_ONE]


def test_the_ends_are_those_of_the_integrated_law():
    rng = random.Random(3)
    for _ in range(50):
        times = sorted(rng.sample(range(1, 40), 5))
        edges = [0.0, *(0.2 * t for t in times), 8.0]
        spans = list(pairwise(edges))
        plus, minus = spans[::2], spans[1::2]
        found = pieces(plus, minus, 8.0)
        law = acceleration_law([(one.start, one.end, one.sign) for one in found])
        np.testing.assert_allclose(ends_of(found), [law.at(8.0, 1), law.at(8.0)], rtol=0, atol=1e-9)


def test_gaps_and_empty_intervals_count():
    assert undetermined_share(pieces([(0, 1)], [(2, 4)], 4.0)) == 0.25
    assert undetermined_share(pieces([(1, 0)], [(0, 4)], 4.0)) == 0.0
    assert undetermined_share(pieces([], [], 4.0)) == 1.0
    with pytest.raises(InputError, match="duration: expected more than 0 s"):
        pieces([], [], 0.0)
