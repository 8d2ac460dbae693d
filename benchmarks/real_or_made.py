"""Fixed small classifier of patches, real or made: ridge logistic regression on random features."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import expit
from scipy.stats import rankdata

Floats = NDArray[np.float64]

SEED, FEATURES = 20, 400
_REACH = 0.15  # scale of the random frequencies, over standardised descriptors
_RIDGE = 1e-3  # on weights, for a mean log-loss
_CLIP = 4.0  # standard deviations


@dataclass(frozen=True, eq=False)
class Judge:
    """Trained classifier."""

    mean: Floats  # (n,), of the descriptors
    spread: Floats  # (n,)
    frequencies: Floats  # (n, features)
    phases: Floats  # (features,)
    weights: Floats  # (n + features + 1,)

    def scores(self, descriptors: Floats) -> Floats:
        """Log-odds (k,) that patches with descriptors (k, n) are real."""
        return _inputs(self, descriptors) @ self.weights


def train(real: Floats, made: Floats) -> Judge:
    """Train on descriptors of real patches (k, n) and made ones (m, n), both of equal weight."""
    rng = np.random.default_rng(SEED)
    both = np.concatenate([real, made])
    size = both.shape[1]
    judge = Judge(
        mean=both.mean(axis=0),
        spread=np.maximum(both.std(axis=0), 1e-6),
        frequencies=_REACH * rng.standard_normal((size, FEATURES)),
        phases=rng.uniform(0.0, 2.0 * np.pi, FEATURES),
        weights=np.zeros(size + FEATURES + 1),
    )
    inputs = _inputs(judge, both)
    target = np.repeat([1.0, 0.0], [len(real), len(made)])
    share = np.where(target > 0, 0.5 / len(real), 0.5 / len(made))

    def loss(weights: Floats) -> tuple[float, Floats]:
        odds = inputs @ weights
        value = share @ np.logaddexp(0.0, np.where(target > 0, -odds, odds))
        slope = inputs.T @ (share * (expit(odds) - target))
        return value + _RIDGE * weights @ weights, slope + 2.0 * _RIDGE * weights

    found = minimize(loss, judge.weights, jac=True, method="L-BFGS-B", options={"maxiter": 500})
    return Judge(judge.mean, judge.spread, judge.frequencies, judge.phases, found.x)


def _inputs(judge: Judge, descriptors: Floats) -> Floats:
    part = np.clip((descriptors - judge.mean) / judge.spread, -_CLIP, _CLIP)
    waves = np.cos(part @ judge.frequencies + judge.phases)
    return np.column_stack([part, waves, np.ones(len(part))])


def area_under_curve(real: Floats, made: Floats) -> float:
    """Probability that a real patch scores above a made one; ties count a half."""
    ranks = rankdata(np.concatenate([real, made]))
    rest = len(real) * (len(real) + 1) / 2.0
    return float((ranks[: len(real)].sum() - rest) / (len(real) * len(made)))
