"""Columns of numbers as text that other programs read."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from itertools import zip_longest

import numpy as np
from numpy.typing import ArrayLike


def csv_of(names: Iterable[str], columns: Iterable[ArrayLike]) -> str:
    """Return columns, each below its name, as comma-separated values.

    Parameters
    ----------
    names : iterable of str
    columns : iterable of array_like, shape (k,)
        Of any lengths; a gap (NaN), and what a shorter column lacks, is an empty cell.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    numbers = [np.asarray(column, dtype=float).tolist() for column in columns]
    rows = zip_longest(*numbers, fillvalue=np.nan)
    writer.writerows(["" if np.isnan(value) else value for value in row] for row in rows)
    return text.getvalue()
