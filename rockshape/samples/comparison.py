"""Comparison of two samples: a test of their size distributions, and of their medians."""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from rockshape.samples.percentiles import interval, percentiles
from rockshape.samples.sample import Sample
from rockshape.samples.weighting import WEIGHTINGS


@dataclass(frozen=True)
class Comparison:
    """How two samples differ, by number of rocks."""

    statistic: float  # of Kolmogorov and Smirnov: the greatest difference of the two distributions
    p: float  # chance of such a difference in samples of one distribution
    d50_ratio: float  # of the first over the second
    low: float  # ends of its 95 % bootstrap interval
    high: float

    def line(self, one: str, other: str) -> str:
        """Line of text on two samples of these names."""
        return (
            f"{one} against {other}: D50 ratio {self.d50_ratio:.3f} ({self.low:.3f} to "
            f"{self.high:.3f}), by number; Kolmogorov and Smirnov: greatest difference "
            f"{self.statistic:.3f}, p {self.p:.2g}"
        )

    def to_dict(self) -> dict[str, float]:
        """Plain values, as `rockshape summarise --json` prints them."""
        return {
            "d50_ratio": self.d50_ratio,
            "d50_ratio_low": self.low,
            "d50_ratio_high": self.high,
            "ks_statistic": self.statistic,
            "ks_p": self.p,
        }


def compare(one: Sample, other: Sample) -> Comparison:
    """Compare the sizes of two samples of at least one rock each."""
    test = stats.ks_2samp(one.sizes, other.sizes)
    number = WEIGHTINGS["number"]
    medians = [
        percentiles(each.sizes, number.weights(each.sizes), (50.0,))[0] for each in (one, other)
    ]
    draws = [each.bootstrap(number.power, (50.0,))[:, 0] for each in (one, other)]
    rng = np.random.default_rng([len(one), len(other)])  # the two are drawn apart
    low, high = interval(draws[0] / rng.permutation(draws[1]))
    return Comparison(
        float(test.statistic), float(test.pvalue), medians[0] / medians[1], float(low), float(high)
    )
