"""Numbers of the world's industrial robots, as the International Federation of Robotics (IFR) gives them."""

from __future__ import annotations

from typing import NamedTuple

from armlab.kin.growth import grown

SOURCE = "International Federation of Robotics (IFR), World Robotics 2025, executive summary"


class Count(NamedTuple):
    """Robots at work in the world at the end of a year."""

    year: int
    robots: float


STOCK = (Count(1973, 3e3), Count(1983, 66e3), Count(1993, 575e3), Count(2003, 800e3), Count(2024, 4.6e6))
"""Operational stock (section 1.8 of the notes)."""

SPANS = ((0, 1), (1, 2), (2, 3), (3, 4), (0, 4))
"""Pairs of `STOCK` between which growth is looked at: each gap, and the whole."""

SALES, SALES_GROWTH, STOCK_GROWTH, OF_LAST_YEAR = 542e3, 0.07, 0.11, 0.09
"""New robots of 2024; rates a year from 2019 to 2024 of new robots and of the stock; growth of the stock in 2024."""

SERVICE = (12.0, 15.0)
"""Years that a robot serves, from and to."""

VALUE, SYSTEMS = 15.7e9, 4.0
"""Value of the robots sold in 2022, dollars, without software and periphery, and the factor to whole systems."""

SHARES = (("China", 0.54), ("Japan, USA, Korea and Germany", 0.26), ("all others", 0.20))
"""Shares of new robots; the first two are the 80 % of five countries."""

BEFORE = 5.0
"""Years from 2019 to 2024."""


class Follows(NamedTuple):
    """A number of the IFR and a number that follows from it.

    Attributes
    ----------
    given : str
    value : float
    unit : str
        ``"robots"`` or ``"$"``.
    says : str
        What the value is.
    """

    given: str
    value: float
    unit: str
    says: str


def following() -> tuple[Follows, ...]:
    """Return what follows from the numbers, each with what it follows from."""
    stock = STOCK[-1].robots
    return (
        Follows(
            "stock of 2024: 4.6 million, 9 % more than a year before",
            stock / (1.0 + OF_LAST_YEAR),
            "robots",
            "stock of 2023",
        ),
        Follows("11 % a year for five years", grown(stock, STOCK_GROWTH, -BEFORE), "robots", "stock of 2019"),
        Follows(
            "542 000 new robots in 2024, 7 % a year for five years",
            grown(SALES, SALES_GROWTH, -BEFORE),
            "robots",
            "new robots of 2019",
        ),
        Follows("China takes 54 % of them", SHARES[0][1] * SALES, "robots", "new robots in China"),
        Follows(
            "a robot serves 12 to 15 years",
            steady(SERVICE[0]),
            "robots",
            "stock that 542 000 a year keep up, at 12 years",
        ),
        Follows(
            "robots for 15.7 billion $ in 2022, systems for four times as much",
            VALUE * SYSTEMS,
            "$",
            "value of the systems",
        ),
    )


def steady(years: float) -> float:
    """Return the stock at which as many robots are taken out of service as are sold, if the sales stay as they are.

    A robot that serves so many years is replaced once in them: stock = sales a year times years.
    """
    return SALES * years
