import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

import rockshape
from rockshape.rock.blas_threads import one_blas_thread
from tests.rocks import lumpy_rock


def blas_threads() -> set[int]:
    return {one["num_threads"] for one in threadpool_info() if one["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def _two_threads():
    with threadpool_limits(limits=2, user_api="blas"):
        assert blas_threads() == {2}
        yield


def test_one_thread_within_and_as_many_as_before_afterwards() -> None:
    with one_blas_thread():
        assert blas_threads() == {1}
    assert blas_threads() == {2}


def test_the_last_of_several_at_once_sets_back_what_the_first_found() -> None:
    first, second = one_blas_thread(), one_blas_thread()
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    assert blas_threads() == {1}
    second.__exit__(None, None, None)
    assert blas_threads() == {2}


def test_measuring_leaves_the_number_of_threads_even_when_it_fails() -> None:
    rockshape.measure(labels=lumpy_rock().mask)
    assert blas_threads() == {2}
    with pytest.raises(rockshape.InputError):
        rockshape.measure(labels=np.zeros((9, 9), dtype=int), method="guess")
    assert blas_threads() == {2}
