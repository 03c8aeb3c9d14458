# SPDX-License-Identifier: GPL-3.0-or-later
"""Which candidates of a frame are near each other, found without an array of all pairs, and the best of those."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from jaxtyping import Bool, Float, Int

Indices = Int[np.ndarray, " _"]
Near = Callable[[Indices, Indices], Bool[np.ndarray, "rows columns"]]

BLOCK = 64


def blocks(places: Float[np.ndarray, " n"], reach: float, size: int) -> Iterator[tuple[Indices, Indices]]:
    """All indices in blocks of `size`, each with those whose place lies within `reach` of one of the block's.

    Both are in rising order, so up to `size` of them are one block as they stand.
    """
    order = np.argsort(places, kind="stable")
    ranked = places[order]
    for first in range(0, len(order), size):
        rows = ranked[first : first + size]
        low = np.searchsorted(ranked, rows[0] - reach)
        high = np.searchsorted(ranked, rows[-1] + reach, side="right")
        yield np.sort(order[first : first + size]), np.sort(order[low:high])


def led_by_the_best(
    scores: Float[np.ndarray, " n"], places: Float[np.ndarray, " n"], reach: float, near: Near
) -> Iterator[tuple[int, Indices]]:
    """Each candidate that no better one has taken, best first, with the free ones near it, which it takes.

    `near(rows, columns)` tells of each pair whether it is near; only pairs whose `places` differ by `reach` at most are
    asked for. Candidates with equal scores keep their order.
    """
    firsts, seconds = [np.zeros(0, np.intp)], [np.zeros(0, np.intp)]
    for rows, columns in blocks(places, reach, BLOCK):
        r, c = np.nonzero(near(rows, columns))
        firsts.append(rows[r])
        seconds.append(columns[c])
    of = np.concatenate(firsts)
    sorting = np.argsort(of, kind="stable")
    others = np.concatenate(seconds)[sorting]
    starts = np.searchsorted(of[sorting], np.arange(len(scores) + 1)).tolist()
    free = np.ones(len(scores), bool)
    for i in np.argsort(-scores, kind="stable").tolist():
        if free[i]:
            followers = others[starts[i] : starts[i + 1]]
            followers = followers[free[followers]]
            free[followers] = False
            yield i, followers
