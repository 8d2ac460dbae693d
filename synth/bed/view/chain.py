"""First points met by lines of sight: chains of points cut at the rows of a view.

A chain is a column's points in the order in which lines of sight from the top of the view to its
bottom meet them. Where it doubles back, the envelope, which never falls, bridges what is hidden.
"""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Ints, Singles


@dataclass(frozen=True, eq=False)
class Crossings:
    """Links of the chains, from one point to the next, that rows of a view cut."""

    link: Ints  # (rows, columns), flat index of the link's first point
    share: Singles  # (rows, columns), of the link before the cut
    columns: int

    def at(self, values: Singles) -> Singles:
        """Values (points, columns) where the chains are cut, linear between the points."""
        flat = values.ravel()
        low = flat[self.link]
        return np.asarray(low + self.share * (flat[self.link + self.columns] - low))


def surface_envelope(rows: Singles) -> Singles:
    """Envelope of a surface whose points, far ones first, lie at such rows."""
    return np.minimum.accumulate(rows[::-1], axis=0)[::-1]


def crossings(rows: Singles, envelope: Singles, first: int, count: int) -> Crossings:
    """Cuts of chains (points, columns) at `count` rows from `first` on.

    Rows beyond the ends of a chain get its end.
    """
    points, columns = rows.shape
    column = np.arange(columns)
    bins = np.ceil(envelope - np.float32(first)).clip(0, count).astype(np.int64)
    bins *= columns
    bins += column
    met = np.bincount(bins.ravel(), minlength=(count + 1) * columns)
    link = met.reshape(count + 1, columns)[:count].cumsum(axis=0)
    link -= 1
    np.clip(link, 0, points - 2, out=link)
    link *= columns
    link += column
    flat = rows.ravel()
    low = flat[link]
    span = flat[link + columns] - low
    level = np.arange(first, first + count, dtype=np.float32)[:, None]
    share = ((level - low) / np.where(span > 0.0, span, np.float32(1.0))).clip(0.0, 1.0)
    return Crossings(link, share, columns)
