"""The gates as JUnit test cases, for continuous integration."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from io import BytesIO

from junitparser import Failure, JUnitXml, TestCase, TestSuite

from validation.execution.run import Run
from validation.report.format import number
from validation.suite.gates import GateResult

# What XML 1.0 can hold no way, escaped or not (section 2.2).
_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def junit_xml(run: Run, *, seconds: float) -> str:
    """JUnit XML with one test case a gate; a failure says found, bound and reason.

    The suite's time is that of the run; a gate itself takes none, as it compares two numbers.
    """
    suite = TestSuite(_text(f"rockshape validate {run.suite.name}"))
    for name, result in zip(_names(run.gates), run.gates, strict=True):
        case = TestCase(name, classname=_text(f"gates.{run.suite.name}"), time=0.0)
        if not result.passed:
            message = (
                f"{result.gate.score}: expected {result.gate.relation} "
                f"{number(result.gate.bound)}, found {number(result.found)}"
            )
            failure = Failure(_text(message), "gate")
            failure.text = _text(result.gate.reason)
            case.result = [failure]
        suite.add_testcase(case)
    document = JUnitXml()
    document.add_testsuite(suite)
    document.update_statistics()
    suite.time = document.time = round(seconds, 3)
    buffer = BytesIO()
    document.write(buffer)
    return buffer.getvalue().decode("utf-8")


def _names(results: Sequence[GateResult]) -> Iterator[str]:
    """Names of the gates, no two alike."""
    seen: Counter[str] = Counter()
    for result in results:
        gate = result.gate
        end = "" if gate.end == "value" else f" {gate.end}"
        name = _text(f"{gate.score}{end} {gate.relation} {gate.bound:.12g}")
        seen[name] += 1
        yield name if seen[name] == 1 else f"{name} ({seen[name]})"


def _text(text: str) -> str:
    """Text with what XML cannot hold as U+FFFD."""
    return _NOT_IN_XML.sub("\ufffd", text)
