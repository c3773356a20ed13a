"""Products of elementary rotations in symbols: all eighteen against numbers, and how they are printed."""

import itertools
import math
import re

import numpy as np
import pytest

from armlab.errors import UnknownName
from armlab.kin.rotation_products import ANGLES, PAIRS, PRODUCTS, product_entries, product_values
from armlab.kin.rotations import rotation_about


def evaluated(axes, angles):
    """Return the numbers of the printed entries, as Python evaluates them."""
    names = {"sin": math.sin, "cos": math.cos, **dict(zip(ANGLES, angles, strict=False))}
    return np.array([[eval(entry, names) for entry in row] for row in product_entries(axes, "text")])


def test_there_are_six_products_about_two_axes_and_twelve_about_three():
    assert len(PAIRS) == 6
    assert len(PRODUCTS) == 18
    assert all(one != other for axes in PRODUCTS for one, other in itertools.pairwise(axes))


@pytest.mark.parametrize("axes", PRODUCTS)
def test_the_formulas_have_the_values_of_the_product(axes, rng):
    for angles in rng.uniform(-4.0, 4.0, (5, 3)):
        turns = [rotation_about(axis, angle) for axis, angle in zip(axes, angles, strict=False)]
        expected = turns[0] @ turns[1] @ (turns[2] if len(axes) == 3 else np.eye(3))
        np.testing.assert_allclose(evaluated(axes, angles), expected, rtol=0, atol=1e-15)
        np.testing.assert_allclose(product_values(axes, angles), expected, rtol=0, atol=1e-15)


def test_the_products_of_the_appendix(truth):
    cases = [case for name, case in truth.items() if name.startswith("CA-")]
    assert len(cases) >= 12
    for case in cases:
        given = case["inputs"]
        angles = [given[name] for name in ANGLES if name in given]
        found = evaluated(given["seq"].lower(), angles)
        np.testing.assert_allclose(found, case["expected"]["R"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("axes", PRODUCTS)
def test_every_entry_is_multiplied_out_with_the_factors_in_the_order_of_the_angles(axes):
    for row in product_entries(axes, "text"):
        for entry in row:
            terms = re.split(r" [+-] ", entry.lstrip("-"))
            assert len(terms) <= 2
            for term in terms:
                names = re.findall(r"\((\w+)\)", term)
                assert names == sorted(names)
                assert len(names) <= len(axes)


def test_how_they_are_written():
    assert product_entries("zxz")[1][0] == r"s_\alpha\,c_\gamma + c_\alpha\,c_\beta\,s_\gamma"
    assert product_entries("zyx")[0][1] == r"c_\alpha\,s_\beta\,s_\gamma - s_\alpha\,c_\gamma"
    assert product_entries("xz", "latex") == (
        (r"\cos(\beta)", r"-\sin(\beta)", "0"),
        (r"\cos(\alpha) \sin(\beta)", r"\cos(\alpha) \cos(\beta)", r"-\sin(\alpha)"),
        (r"\sin(\alpha) \sin(\beta)", r"\sin(\alpha) \cos(\beta)", r"\cos(\alpha)"),
    )


@pytest.mark.parametrize("axes", ["zz", "zzx", "x", "abc", "XYZ"])
def test_other_products_are_refused_with_a_list(axes):
    with pytest.raises(UnknownName, match="Available: xy, xyx"):
        product_entries(axes)
