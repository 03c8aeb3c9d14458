# SPDX-License-Identifier: GPL-3.0-or-later
"""Optimal one-to-one assignment, so that evaluation needs no library beyond NumPy."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int


def assign(weights: Float[np.ndarray, "n m"]) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " k"]]:
    """Pair rows with columns, each used once at most, so that the sum of the pairs' weights is greatest.

    Only pairs of positive weight are made. Pairs that have no rival are made at once; the others are solved by shortest
    augmenting paths with dual prices (Jonker and Volgenant, Computing 38, 1987).

    Returns:
        Row and column of each pair, by rising row.
    """
    possible = weights > 0
    rivals_in_row, rivals_in_column = possible.sum(axis=1), possible.sum(axis=0)
    alone = possible & (rivals_in_row == 1)[:, None] & (rivals_in_column == 1)
    row, column = np.nonzero(alone)
    rows = np.flatnonzero((rivals_in_row > 0) & ~alone.any(axis=1))
    columns = np.flatnonzero((rivals_in_column > 0) & ~alone.any(axis=0))
    if len(rows):
        contested = np.maximum(weights[np.ix_(rows, columns)], 0.0).astype(np.float64)
        if len(rows) <= len(columns):
            r, c = _match_all_rows(-contested)
        else:
            c, r = _match_all_rows(-contested.T)
        made = contested[r, c] > 0
        row, column = np.append(row, rows[r[made]]), np.append(column, columns[c[made]])
    order = np.argsort(row)
    return row[order], column[order]


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
