"""The plug-in where nobody asks for it: no heavy import, no warning, and it can be switched off."""

import pytest

pytest_plugins = ["pytester"]

HEAVY = ("numpy", "pandas", "scipy", "msgspec", "synth", "rockshape", "validation.suite")
TEST = f"""
import sys

def test_nothing_heavy_is_imported():
    assert [name for name in {HEAVY!r} if name in sys.modules] == []
"""


def test_a_start_imports_nothing_heavy_and_warns_of_nothing(pytester) -> None:
    pytester.makepyfile(TEST)
    result = pytester.runpytest_subprocess("-W", "error", "-p", "no:hypothesispytest")
    result.assert_outcomes(passed=1)


def test_it_can_be_switched_off(pytester) -> None:
    pytester.makepyfile("def test_nothing():\n    pass\n")
    pytester.runpytest_subprocess("-p", "no:rockshape").assert_outcomes(passed=1)
    result = pytester.runpytest_subprocess("-p", "no:rockshape", "--rockshape-suite", "ci")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
