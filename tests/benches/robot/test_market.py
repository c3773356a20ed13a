"""The page of the market: the counts, the calculator, and what follows from the numbers."""

import math

import pytest

from armlab.benches.robot.market.examples import EXAMPLES, ChooseMarketExample
from armlab.benches.robot.market.facts import FACTS
from armlab.benches.robot.market.numbers import SALES, SHARES, SPANS, STOCK, following, steady
from armlab.benches.robot.market.state import NUMBERS, ComputeNumber, Market, TakeSpan
from armlab.benches.robot.market.ui.chart import chart_markup, percent, robots
from armlab.benches.robot.market.ui.page import calculator_markup, numbers_markup, spans_markup
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.state import State, apply
from armlab.ui.html import joined
from support.done import done
from support.forms import asked


def opened(*commands):
    return done(State.initial(catalogue()["puma560"]), *commands)


def fact(name, state):
    return FACTS.facts[name].now(state).value


def test_it_opens_with_the_growth_of_half_a_century(truth):
    case = truth["C1.8-cagr-1973-2024"]
    state = opened()
    assert fact("rate", state) == pytest.approx(case["expected"]["cagr"], abs=case["tol"])
    assert [count.robots for count in STOCK] == [3e3, 66e3, 575e3, 800e3, 4.6e6]


@pytest.mark.parametrize(("span", "rate"), list(zip(SPANS, (0.362, 0.242, 0.0336, 0.0869, 0.1547), strict=True)))
def test_the_rates_between_counts(span, rate):
    assert fact("rate", opened(TakeSpan(*span))) == pytest.approx(rate, abs=6e-4)


@pytest.mark.parametrize("name", NUMBERS)
def test_whatever_is_computed_the_four_numbers_agree(name):
    state = opened(Set(Market, "years", 21.0), ComputeNumber(name))
    found = state[Market].found
    assert state[Market].unknown == name
    assert found["begin"] * (1.0 + found["rate"]) ** found["years"] == pytest.approx(found["end"], rel=1e-12)
    # The number that was computed before is kept as if it had been typed.
    assert found["rate"] == pytest.approx((4.6e6 / 3e3) ** (1 / 21) - 1.0, rel=1e-12)


def test_the_field_of_the_unknown_cannot_be_filled_and_the_others_become_commands():
    state = opened()

    def typed(cell, text):
        return asked(lambda form: joined(calculator_markup(form, state[Market])), cell, text)

    assert typed("begin", "66000") == (Set(Market, "begin", 66000.0),)
    assert typed("years", "10") == (Set(Market, "years", 10.0),)
    assert typed("rate", "11 %") == ()
    assert typed("compute end", "") == (ComputeNumber("end"),)
    state = apply(state, ComputeNumber("end"))
    (command,) = typed("rate", "11 %")
    assert command.value == pytest.approx(0.11, rel=1e-12)
    for text in ("fast", "1e9 %"):
        with pytest.raises(InputError, match=r"^rate: expected a number in % from −99\.9 to 10000, got "):
            typed("rate", text)


def test_a_single_year_is_one_and_a_span_is_chosen_only_with_its_years():
    def shown(state):
        texts = []

        def markup(form):
            texts.append(joined(spans_markup(form, state[Market]), calculator_markup(form, state[Market])))
            return texts[-1]

        asked(markup, "years", "10")
        return str(texts[-1])

    double = opened(ComputeNumber("end"), Set(Market, "years", 1.0), Set(Market, "rate", 1.0))
    assert "a year over 1 year: 100.0 % in all. At this rate a value doubles in 1 year." in shown(double)
    assert shown(opened(TakeSpan(0, 4))).count('aria-pressed="true">1973–2024') == 1
    assert 'aria-pressed="true">1973–2024' not in shown(opened(TakeSpan(0, 4), Set(Market, "years", 10.0)))


@pytest.mark.parametrize(
    ("commands", "told"),
    [
        ([Set(Market, "begin", 0.0)], "value at the beginning|begin"),
        ([Set(Market, "years", 0.0)], "years: expected a number that is not zero"),
        ([ComputeNumber("end"), Set(Market, "rate", -1.0)], "rate"),
        ([ComputeNumber("end"), Set(Market, "rate", 99.0)], "end: it would be"),
        ([Set(Market, "years", 0.5)], r"rate: it would be 2.351e\+08 %, and the lab computes from -99.9 % to 1e\+04 %"),
        ([ComputeNumber("years"), Set(Market, "rate", 0.0)], "with 0 % a year 3000 never becomes"),
        ([TakeSpan(3, 1)], "the earlier first, got 3, 1"),
        ([ComputeNumber("weather")], "weather"),
    ],
)
def test_what_cannot_be_computed_is_refused_and_the_state_stays(commands, told):
    state = opened(*commands[:-1])
    with pytest.raises(InputError, match=told):
        apply(state, commands[-1])


def test_what_follows_agrees_with_the_numbers_it_follows_from():
    values = [each.value for each in following()]
    assert values[0] * 1.09 == pytest.approx(4.6e6)
    assert values[1] * 1.11**5 == pytest.approx(4.6e6)
    assert values[2] * 1.07**5 == pytest.approx(542e3)
    assert values[3] == pytest.approx(0.54 * SALES)
    assert values[5] == pytest.approx(62.8e9)
    assert sum(part for _, part in SHARES) == pytest.approx(1.0)
    # A stock that loses one part in its service time each year, and gets the sales, stays.
    assert steady(12.0) - steady(12.0) / 12.0 + SALES == pytest.approx(steady(12.0))
    text = str(joined(numbers_markup()))
    assert "386 k: new robots of 2019" in text
    assert "62.8 billion $: value of the systems" in text


@pytest.mark.parametrize("key", EXAMPLES)
@pytest.mark.parametrize("log", [True, False])
def test_the_chart_of_every_example_is_drawn(key, log):
    state = opened(ChooseMarketExample(key), Set(Market, "log", log))
    assert state[Market].example == key
    text = str(chart_markup(state[Market]))
    assert text.count('class="ma-count"') == len(STOCK)
    assert "nan" not in text
    assert text.count("<path") >= 3


def test_on_the_logarithmic_axis_constant_growth_is_a_straight_line():
    text = str(chart_markup(opened()[Market]))
    line = next(part for part in text.split("<path ")[1:] if "ma-grown" in part)
    d = line.partition('d="M')[2].partition('"')[0]
    points = [tuple(map(float, each.split())) for each in d.split("L")]
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(points[::20], points[20::20], strict=False) if b[0] > a[0]]
    assert max(slopes) - min(slopes) < 0.02 * abs(slopes[0])


def test_numbers_are_short():
    assert (robots(575e3), robots(4.6e6), robots(12.0), robots(1.5e10)) == ("575 k", "4.6 M", "12", "15 G")
    assert percent(0.0336) == "3.4 %"
    assert math.isclose(fact("doubling", opened()), 4.8192, abs_tol=1e-3)
