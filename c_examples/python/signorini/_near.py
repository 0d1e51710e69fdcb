"""Points that are near others, and how far apart and how exact they are."""

import numpy as np

_LEAF = 48  # points of which all distances are looked at
_FEW = 8  # digits that are fewer than a number has


def near_pairs(places, asked, limits):
    """Pairs of an asked point and a place nearer to it than its limit: their numbers and distances, nearest first for each."""
    found, left = [], [(np.arange(len(places)), np.arange(len(asked)))]
    while left:
        of, to = left.pop()
        if not len(of):
            continue
        x = places[of]
        low, high = x.min(axis=0), x.max(axis=0)
        beyond = np.maximum(low - asked[to], 0) + np.maximum(asked[to] - high, 0)
        to = to[np.linalg.norm(beyond, axis=1) <= limits[to]]
        if not len(to):
            continue
        if len(of) > _LEAF:
            left += [(half, to) for half in _halves(of, x, low, high)]
            continue
        away = np.linalg.norm(asked[to][:, None] - x, axis=2)
        k, p = np.nonzero(away <= limits[to][:, None])
        found.append((to[k], of[p], away[k, p]))
    if not found:
        return np.zeros(0, int), np.zeros(0, int), np.zeros(0)
    points, others, away = (np.concatenate(parts) for parts in zip(*found))
    order = np.lexsort((others, away, points))
    return points[order], others[order], away[order]


def _halves(of, x, low, high):
    axis = (high - low).argmax()
    order = np.argpartition(x[:, axis], len(of) // 2)
    return of[order[:len(of) // 2]], of[order[len(of) // 2:]]


class Spacing:
    """Of places: at_most, for each more than its distance to the nearest other one, and at, that distance of some. Those
    nearer than same are at one place."""

    def __init__(self, places, same):
        self._places, self._same, self.at_most = places, same, np.zeros(len(places))
        self._leaf, self._leaves, left = np.zeros(len(places), int), [], [np.arange(len(places))]
        while left:
            of = left.pop()
            x = places[of]
            low, high = x.min(axis=0, initial=np.inf), x.max(axis=0, initial=-np.inf)
            if len(of) > _LEAF:
                left += _halves(of, x, low, high)
                continue
            self._leaf[of], self.at_most[of] = len(self._leaves), np.linalg.norm(high - low)
            self._leaves.append(of)

    def at(self, nodes):
        """The distance of each node to the nearest other one."""
        limits = np.zeros(len(nodes))
        for leaf in np.unique(self._leaf[nodes]):
            asked, of = np.flatnonzero(self._leaf[nodes] == leaf), self._leaves[leaf]
            limits[asked] = self._least(np.linalg.norm(self._places[nodes[asked]][:, None] - self._places[of], axis=2))
        limits = np.where(np.isfinite(limits), limits, self.at_most.max(initial=0.0))
        points, _, away = near_pairs(self._places, self._places[nodes], limits)
        np.minimum.at(limits, points[away > self._same], away[away > self._same])
        return limits

    def _least(self, away):
        return np.where(away > self._same, away, np.inf).min(axis=1, initial=np.inf)


def last_digit(values):
    """The place of the last digit that the largest of some numbers has, if none has more than a few: .001 of 12.345 and
    .25; else 0."""
    values = abs(values[values != 0])
    largest = values.max(initial=0.0)

    def longer(digits):
        shown = values * 10.0 ** (digits - 1 - np.floor(np.log10(values)))
        # What is left is that of products with powers of ten.
        return values[abs(shown - np.rint(shown)) > 1e-13 * 10.0 ** digits]
    if not largest or len(longer(_FEW)):
        return 0.0
    digits = 1
    while len(values := longer(digits)):
        digits += 1
    return 10.0 ** (np.floor(np.log10(largest)) - digits + 1)
