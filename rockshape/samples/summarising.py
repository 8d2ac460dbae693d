"""Making of a summary from a sample."""

from rockshape.samples import form_classes
from rockshape.samples.abundance import Abundance, fit_abundance
from rockshape.samples.folk_ward import PERCENTS as FOLK_WARD_PERCENTS
from rockshape.samples.folk_ward import folk_ward
from rockshape.samples.percentiles import PERCENTS, interval, percentiles
from rockshape.samples.sample import Sample
from rockshape.samples.summary import Distribution, Summary
from rockshape.samples.weighting import WEIGHTINGS, Weighting

MIN_ROCKS = 5  # for a distribution


def summary_of(
    sample: Sample, *, area_m2: float | None = None, least_m: float | None = None
) -> Summary:
    """Summary of a sample; with the area that it lies on, in m², of its abundance too.

    The abundance is that of rocks wider than `least_m`, by default the smallest of the sample.
    """
    enough = len(sample) >= MIN_ROCKS
    classes, classified = _classes(sample)
    return Summary(
        sample=sample,
        distributions=tuple(_distribution(sample, each) for each in WEIGHTINGS.values())
        if enough
        else (),
        classes=classes,
        classified=classified,
        abundance=None if area_m2 is None else _abundance(sample, area_m2, least_m),
    )


def _distribution(sample: Sample, weighting: Weighting) -> Distribution:
    low, high = interval(sample.bootstrap(weighting.power, PERCENTS))
    weights = weighting.weights(sample.sizes)
    graphic = None
    if sample.column.unit == "mm":
        graphic = folk_ward(percentiles(sample.sizes, weights, FOLK_WARD_PERCENTS))
    values = percentiles(sample.sizes, weights, PERCENTS)
    return Distribution(weighting, PERCENTS, values, low, high, graphic)


def _classes(sample: Sample) -> tuple[dict[str, dict[str, float]], dict[str, int]]:
    """Shares of the classes that the table's columns tell."""
    found: dict[str, dict[str, float]] = {}
    counted: dict[str, int] = {}

    def tell(scheme: str, names: tuple[str, ...], classes: form_classes.Classes) -> None:
        if len(classes):
            shares = form_classes.shares(classes, len(names))
            found[scheme] = dict(zip(names, shares.tolist(), strict=True))
            counted[scheme] = len(classes)

    a, b, c = sample.half_axes_m.T
    tell("Zingg", form_classes.ZINGG, form_classes.zingg(a, b, c))
    tell("Sneed and Folk", form_classes.SNEED_FOLK, form_classes.sneed_folk(a, b, c))
    tell("Powers", form_classes.POWERS, form_classes.powers(sample.roundness))
    tell("Krumbein", form_classes.KRUMBEIN, form_classes.krumbein(sample.roundness))
    return found, counted


def _abundance(sample: Sample, area_m2: float, least_m: float | None) -> Abundance:
    diameters_m = sample.sizes / 1000
    least = float(diameters_m.min()) if least_m is None else least_m
    return fit_abundance(diameters_m, area_m2=area_m2, least_m=least)
