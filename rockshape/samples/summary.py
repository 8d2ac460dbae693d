"""Summary of a sample: number, size distribution, classes of form and roundness, abundance."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.samples.abundance import LEAST_K, Abundance
from rockshape.samples.folk_ward import FolkWard
from rockshape.samples.sample import Sample
from rockshape.samples.weighting import Weighting


@dataclass(frozen=True, eq=False)
class Distribution:
    """Percentiles of size by one weighting, with the ends of 95 % bootstrap intervals."""

    weighting: Weighting
    percents: tuple[float, ...]
    values: Floats  # (k,)
    low: Floats
    high: Floats
    folk_ward: FolkWard | None  # of sizes in mm alone

    def lines(self, unit: str) -> Iterator[str]:
        """Yield the lines of text that tell it."""
        for percent, value, low, high in zip(
            self.percents, self.values, self.low, self.high, strict=True
        ):
            yield f"    D{percent:<3g} {value:8.4g} {unit}  ({low:.4g} to {high:.4g})"
        graphic = self.folk_ward
        if graphic is not None:
            yield (
                f"    mean {graphic.mean_phi:.2f} φ, sorting {graphic.sorting_phi:.2f} φ "
                f"({graphic.sorting_class}), skewness {graphic.skewness:+.2f} "
                f"({graphic.skewness_class}), kurtosis {graphic.kurtosis:.2f}"
            )

    def to_dict(self) -> dict[str, Any]:
        """Plain values; a number that is not finite is None."""
        told: dict[str, Any] = {"called": self.weighting.field_name}
        for percent, value, low, high in zip(
            self.percents, self.values, self.low, self.high, strict=True
        ):
            told[f"d{percent:g}"] = {"value": float(value), "low": float(low), "high": float(high)}
        graphic = self.folk_ward
        if graphic is not None:
            told["folk_ward"] = {
                name: float(value) if np.isfinite(value) else None
                for name, value in vars(graphic).items()
            } | {"sorting_class": graphic.sorting_class, "skewness_class": graphic.skewness_class}
        return told


@dataclass(frozen=True, eq=False)
class Summary:
    """What a sample amounts to."""

    sample: Sample
    distributions: tuple[Distribution, ...]  # none of fewer rocks than `MIN_ROCKS`
    classes: Mapping[str, Mapping[str, float]]  # share of each class, by scheme
    classified: Mapping[str, int]  # rocks by scheme
    abundance: Abundance | None

    def __str__(self) -> str:
        return "\n".join(self.lines("sample"))

    def lines(self, name: str) -> Iterator[str]:
        """Yield the lines of text that tell it."""
        sample, unit = self.sample, self.sample.column.unit
        left_out = ", ".join(f"{count} {reason}" for reason, count in sample.left_out.items())
        yield f"{name}: {_counted(len(sample))} by {sample.column.name}" + (
            f"; left out: {left_out}" if left_out else ""
        )
        if not self.distributions and len(sample):
            yield f"  too few for a distribution; sizes {_range(sample.sizes)} {unit}".rstrip()
        for distribution in self.distributions:
            yield f"  {distribution.weighting.name} ({distribution.weighting.field_name}):"
            yield from distribution.lines(unit)
        for scheme, shares in self.classes.items():
            told = ", ".join(
                f"{word} {100 * share:.0f} %" for word, share in shares.items() if share
            )
            yield f"  {scheme} ({_counted(self.classified[scheme])}): {told}"
        if self.distributions and sample.found_sd:
            share = f"{100 * sample.found_sd:.2g} %"
            yield f"  intervals of size include {share} (standard deviation) for finding the rocks"
        if sample.soft_outlines:
            yield f"  roundness of {_counted(sample.soft_outlines)} with a soft outline left out"
        if self.abundance is not None:
            fit = self.abundance
            told = f"k {fit.k:.3f} ({fit.low:.3f} to {fit.high:.3f})"
            if fit.k < 1.01 * LEAST_K:
                told = f"k at most {LEAST_K:g}"
            covered = f"{100 * fit.covered:.1f} % of the ground covered"
            yield f"  abundance: {covered}; Golombek and Rapp's {told}"

    def to_dict(self) -> dict[str, Any]:
        """Plain values, as `rockshape summarise --json` prints them."""
        sample = self.sample
        told: dict[str, Any] = {
            "rocks": len(sample),
            "left_out": sample.left_out,
            "size_column": sample.column.name,
            "unit": sample.column.unit,
            "distributions": {each.weighting.name: each.to_dict() for each in self.distributions},
            "classes": {
                scheme: {"rocks": self.classified[scheme], "shares": dict(shares)}
                for scheme, shares in self.classes.items()
            },
            "soft_outlines": sample.soft_outlines,
            "found_sd": sample.found_sd,
        }
        if self.abundance is not None:
            fit = self.abundance
            told["abundance"] = {
                "covered": fit.covered,
                "k": fit.k,
                "k_low": fit.low,
                "k_high": fit.high,
                "rocks": fit.rocks,
            }
        return told


def _counted(count: int) -> str:
    return "1 rock" if count == 1 else f"{count} rocks"


def _range(sizes: np.ndarray) -> str:
    return f"{sizes.min():.4g} to {sizes.max():.4g}"
