# SPDX-License-Identifier: GPL-3.0-or-later
"""Optimal one-to-one assignment, so that evaluation needs no library beyond NumPy."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int


def assign(weights: Float[np.ndarray, "n m"]) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " k"]]:
    """Pair rows with columns, each used once at most, so that the sum of the pairs' weights is greatest.

    Only pairs of positive weight are made. Shortest augmenting paths with dual prices (Jonker and Volgenant,
    Computing 38, 1987), after rows and columns without any positive weight are put aside.

    Returns:
        Row and column of each pair, by rising row.
    """
    rows = np.flatnonzero((weights > 0).any(axis=1))
    columns = np.flatnonzero((weights > 0).any(axis=0))
    if not len(rows):
        return rows, columns
    positive = np.maximum(weights[np.ix_(rows, columns)], 0.0).astype(np.float64)
    if (positive > 0).sum() == len(rows) == len(columns):
        return rows, columns[positive.argmax(axis=1)]
    if len(rows) <= len(columns):
        row, column = _match_all_rows(-positive)
    else:
        column, row = _match_all_rows(-positive.T)
    made = positive[row, column] > 0
    row, column = row[made], column[made]
    order = np.argsort(row)
    return rows[row[order]], columns[column[order]]


def _match_all_rows(cost: Float[np.ndarray, "n m"]) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, " n"]]:
    """Give every row a column of its own at the least total cost; there are at least as many columns as rows."""
    n, m = cost.shape
    row_price, column_price = np.zeros(n), np.zeros(m)
    row_of = np.full(m, -1)
    for start in range(n):
        distance = np.full(m, np.inf)
        came_from = np.full(m, -1)
        done = np.zeros(m, np.bool_)
        row, travelled, last = start, 0.0, -1
        while True:
            through_row = travelled + cost[row] - row_price[row] - column_price
            better = ~done & (through_row < distance)
            distance[better] = through_row[better]
            came_from[better] = last
            column = int(np.argmin(np.where(done, np.inf, distance)))
            travelled = distance[column]
            if row_of[column] < 0:
                break
            done[column] = True
            row, last = row_of[column], column
        row_price[start] += travelled
        row_price[row_of[done]] += travelled - distance[done]
        column_price[done] += distance[done] - travelled
        while column >= 0:
            previous = came_from[column]
            row_of[column] = start if previous < 0 else row_of[previous]
            column = previous
    columns = np.flatnonzero(row_of >= 0)
    return row_of[columns], columns
