"""What every timing law in the folder keeps: ends, rest, monotone, derivatives, continuity as stated, peaks, bounds."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.motion.law_types import law_types
from armlab.kin.motion.limits import NAMES, Limits

STEP = 1e-5


def away_from(places, duration, rng, count=300):
    t = rng.uniform(2 * STEP, 1 - 2 * STEP, count) * duration
    near = np.abs(t[:, None] - places).min(axis=1, initial=duration) < 3 * STEP * duration
    return t[~near]


@pytest.mark.parametrize(("duration", "distance"), [(1.0, 1.0), (0.3, 1.0), (40.0, 2.5)])
def test_it_goes_from_0_to_its_distance_and_never_back(law_case, duration, distance):
    kind, options, *_ = law_case
    law = kind.law(duration, distance, **scaled(options, duration, distance))
    assert law.duration == pytest.approx(duration, rel=1e-14)
    assert float(law.at(0.0)) == pytest.approx(0.0, abs=1e-14)
    assert float(law.at(duration)) == pytest.approx(distance, rel=1e-12)
    assert law.monotone
    assert np.all(np.diff(law.at(np.linspace(0, duration, 2001))) >= -1e-12 * distance)
    np.testing.assert_allclose(law.span, (0.0, distance), rtol=0, atol=1e-12 * distance)


def scaled(options, duration, distance):
    """Return end speeds that mean the same on another distance and time."""
    return {k: v * distance / duration if k in ("sdot_start", "sdot_end") else v for k, v in options.items()}


def test_before_and_after_it_stands_still(law_case):
    kind, options, *_ = law_case
    law = kind.law(1.0, **options)
    np.testing.assert_allclose(law.at([-5.0, 7.0]), [0.0, 1.0], rtol=0, atol=1e-13)
    for order in (1, 2, 3):
        assert law.at([-5.0, 7.0], order).tolist() == [0.0, 0.0]


def test_a_time_that_is_not_a_number_is_refused(law_case):
    kind, options, *_ = law_case
    with pytest.raises(InputError, match="t: expected numbers"):
        kind.law(1.0, **options).at([0.5, float("nan")])


def test_its_derivatives_are_those_of_central_differences(law_case, rng):
    kind, options, *_ = law_case
    law = kind.law(2.0, **options)
    t = away_from(law.pieces, 2.0, rng)
    h = 2.0 * STEP
    for order in range(1, 4):
        differences = (law.at(t + h, order - 1) - law.at(t - h, order - 1)) / (2 * h)
        size = max(np.abs(law.at(t, k)).max() for k in range(order + 1))
        np.testing.assert_allclose(law.at(t, order), differences, rtol=0, atol=1e-6 * size)


def test_its_class_of_continuity_is_the_one_stated(law_case):
    kind, options, inside, from_rest = law_case
    law = kind.law(1.0, **options)
    assert law.continuity == inside
    assert law.continuity_from_rest == from_rest
    eps = 1e-9
    places = np.concatenate([[0.0], law.breaks, [1.0]])
    for order in range(4):
        jumps = np.abs(law.at(places + eps, order) - law.at(places - eps, order))
        size = max(np.abs(law.at(np.linspace(0, 1, 1001), k)).max() for k in range(4))
        if order <= from_rest:
            assert jumps.max() < 1e-6 * size
        elif order == from_rest + 1:
            assert jumps.max() > 1e-3 * np.abs(law.at(np.linspace(0, 1, 1001), order)).max()


def test_exact_peaks_are_those_of_dense_samples(law_case):
    kind, options, *_ = law_case
    law = kind.law(1.0, **options)
    t = np.concatenate([np.linspace(0, 1, 50001), law.pieces, np.maximum(law.pieces - 1e-12, 0.0)])
    for order, peak in ((1, law.peak_speed), (2, law.peak_acceleration), (3, law.peak_jerk)):
        dense = np.abs(law.at(t, order)).max()
        assert peak >= dense * (1 - 1e-10)
        assert peak == pytest.approx(dense, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    "limits", [(1.0, 1.0, 1.0), (0.1, 5.0, 100.0), (10.0, 0.3, 100.0), (10.0, 50.0, 0.2), (np.inf, 1.0, 2.0)]
)
@pytest.mark.parametrize("distance", [1.0, 0.02, 30.0])
def test_as_fast_as_allowed_meets_a_bound_and_exceeds_none(law_case, limits, distance):
    kind, *_ = law_case
    if kind.key == "constant" and np.isinf(limits[0]):
        with pytest.raises(InputError, match="limit of velocity: Constant speed needs one"):
            kind.shaped(Limits(*limits), distance=distance)
        return
    law = kind.shaped(Limits(*limits), distance=distance)
    used = np.array([law.peak_speed, law.peak_acceleration, law.peak_jerk]) / limits
    # What jumps keeps no limit of the next derivative in any time, and is refused where it has to.
    count = int(min(law.continuity_from_rest, 2)) + 1
    assert max(used[:count]) == pytest.approx(1.0, rel=1e-9)
    assert law.distance == pytest.approx(distance, rel=1e-10)
    if count == 3:
        assert kind.within(Limits(*limits), distance=distance).duration == law.duration
    else:
        with pytest.raises(InputError, match=f"limit of {NAMES[count]}: .* so no time keeps it"):
            kind.within(Limits(*limits), distance=distance)


@pytest.mark.parametrize("k", [0.25, 3.0])
def test_stretched_by_k_its_derivatives_shrink_by_powers_of_k(law_case, k):
    kind, options, *_ = law_case
    law = kind.law(2.0, **options)
    slow = law.stretched(k)
    assert slow.duration == pytest.approx(2.0 * k)
    t = np.linspace(0.01, 1.99, 57)
    for order in range(4):
        expected = law.at(t, order) / k**order
        np.testing.assert_allclose(slow.at(k * t, order), expected, rtol=0, atol=1e-11 * (np.abs(expected).max() + 1))


def test_every_law_says_what_it_is():
    for key, kind in law_types().items():
        assert kind.key == key
        assert kind.title
        for field in kind.fields:
            assert field.title
            field.checked(field.default)
