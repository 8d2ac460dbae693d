"""Summary line of a measurement: what was measured, what is missing and why."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from rockshape.measurement import Measurement, Rock
from rockshape.measures import Measure, Reason

PART_APART = 0.05  # of a rock's pixels: what is told
NO_RANGE = "no range: 3-D measures are empty; give --range FILE (and --camera FILE for z-depth)"


def summarise(measurement: Measurement) -> str:
    """Line on the rocks, the measures of each that are missing, the ground and the camera."""
    observation = measurement.observation
    parts = [_counted(len(measurement.rocks), "rock")]
    flat = [each for each in measurement.measures if not each.needs_range]
    solid = [each for each in measurement.measures if each.needs_range]
    parts += _completeness("2-D", flat, measurement.rocks)
    if observation.points_m is None and solid:
        parts.append(NO_RANGE)
    else:
        parts += _completeness("3-D", solid, measurement.rocks)
    if measurement.ground is not None:
        parts.append(f"ground scatter {100 * measurement.ground.plane.sigma_m:.2g} cm")
    if observation.resection is not None:
        residual = observation.resection.residual_px
        parts.append(f"camera resected from the range, residual {residual:.2f} px")
    if observation.left_out:
        why = ", ".join(f"{reason} {count}" for reason, count in observation.left_out.items())
        total = sum(observation.left_out.values())
        parts.append(f"range of {total} of {observation.image.size} pixels left out ({why})")
    flying = sum(rock.points.flying_points for rock in measurement.rocks)
    spikes = sum(rock.points.spike_points for rock in measurement.rocks)
    if flying or spikes:
        parts.append(
            f"{flying + spikes} points of rocks left out (flying {flying}, spikes {spikes})"
        )
    if observation.pixel_size_m is not None:
        parts.append(f"pixel size {1000 * observation.pixel_size_m:.4g} mm")
    parts += _in_pieces(measurement)
    parts += observation.notes
    return "; ".join(parts)


def _in_pieces(measurement: Measurement) -> list[str]:
    """Part of the line on rocks of whose pixels a part is not measured, as it lies apart."""
    measured = {rock.number: rock.area_px for rock in measurement.rocks}
    count = sum(
        measured.get(each.id, 0) < (1 - PART_APART) * int(np.count_nonzero(each.mask))
        for each in measurement.instances
    )
    return [f"{_counted(count, 'rock')} in pieces, the largest of each measured"] if count else []


def _completeness(name: str, measures: Sequence[Measure], rocks: Sequence[Rock]) -> list[str]:
    """Part of the line on the measures of one dimension; none where there is nothing to tell."""
    if not measures or not rocks:
        return []
    lacking = [reasons for rock in rocks if (reasons := _reasons(rock, measures))]
    if not lacking:
        return [f"all {name} measures of each"]
    counts = Counter(reason for reasons in lacking for reason in reasons)
    why = ", ".join(f"{reason} {count}" for reason, count in counts.most_common())
    complete = len(rocks) - len(lacking)
    if not complete:
        return [f"some {name} measures missing in every rock ({why})"]
    return [f"all {name} measures of {complete}, some missing in {len(lacking)} ({why})"]


def _reasons(rock: Rock, measures: Sequence[Measure]) -> set[Reason]:
    """Reasons why measures of a rock are missing."""
    readings = (rock.readings[measure.column] for measure in measures)
    return {reading.reason for reading in readings if reading.reason is not None}


def _counted(count: int, noun: str) -> str:
    return f"{count or 'no'} {noun}{'' if count == 1 else 's'}"
