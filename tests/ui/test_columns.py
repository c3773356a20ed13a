"""Columns of numbers as text that other programs read."""

import numpy as np

from armlab.ui.columns import csv_of


def test_gaps_and_what_a_shorter_column_lacks_are_empty_cells():
    said = csv_of(["t, s", "a", "b"], [np.array([0.0, 0.5, 1.0]), np.array([1.0, np.nan, -2.5]), [3.0]])
    assert said == '"t, s",a,b\n0.0,1.0,3.0\n0.5,,\n1.0,-2.5,\n'


def test_without_columns_there_are_the_names():
    assert csv_of(["t"], []) == "t\n"
