import numpy as np
import pytest
from scipy.interpolate import BSpline

from rockshape.surface.basis import Knots, derivative_net, evaluate, overlaps


@pytest.mark.parametrize("order", [2, 3, 4, 5])
@pytest.mark.parametrize("more", [0, 1, 6])
def test_agrees_with_scipy(order: int, more: int, rng: np.random.Generator) -> None:
    knots = Knots(order + more, order)
    inner = np.linspace(0, 1, knots.spans + 1)[:-1]
    place = np.concatenate([inner, rng.uniform(size=100), [1.0]])
    for derivative in range(order):
        basis = evaluate(knots, place, derivative=derivative)
        full = np.zeros((len(place), knots.count))
        np.put_along_axis(full, basis.span[:, None] + np.arange(order), basis.values.T, axis=1)
        for number, column in enumerate(full.T):
            alone = np.eye(knots.count)[number]
            expected = BSpline(knots.values(), alone, order - 1)(place, nu=derivative)
            # a derivative grows with the knots' number to its order
            assert column == pytest.approx(
                expected, abs=1e-12 * (order * knots.spans) ** derivative
            )


def test_the_basis_sums_to_one_at_the_knots_too() -> None:
    knots = Knots(10)
    place = np.linspace(0, 1, 8)
    assert evaluate(knots, place).values.sum(axis=0) == pytest.approx(1, abs=1e-14)


def test_the_net_of_the_derivative(rng: np.random.Generator) -> None:
    knots = Knots(9, 4)
    vertices = rng.normal(size=9)
    second = BSpline(knots.values(), vertices, 3).derivative(2)
    lower = BSpline(knots.values()[2:-2], derivative_net(knots, 2) @ vertices, 1)
    place = np.linspace(0, 0.999, 50)
    assert lower(place) == pytest.approx(second(place))


@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_overlaps_are_integrals(derivative: int) -> None:
    knots = Knots(7)
    place = (np.arange(20_000) + 0.5) / 20_000
    rows = np.column_stack(
        [BSpline(knots.values(), row, 3)(place, nu=derivative) for row in np.eye(7)]
    )
    # the midpoint rule's error is 1e-9 of the fourth power of the knots' number
    assert overlaps(knots, derivative) == pytest.approx(rows.T @ rows / 20_000, rel=1e-5, abs=1e-5)
