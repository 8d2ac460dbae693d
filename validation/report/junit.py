"""The gates as JUnit test cases, for continuous integration."""

from io import BytesIO

from junitparser import Failure, JUnitXml, TestCase, TestSuite

from validation.execution.run import Run
from validation.report.format import number


def junit_xml(run: Run) -> str:
    """JUnit XML with one test case a gate; a failure says found, bound and reason."""
    suite = TestSuite(f"rockshape validate {run.suite.name}")
    for result in run.gates:
        case = TestCase(
            f"{result.gate.score} {result.gate.relation} {number(result.gate.bound)}",
            classname=f"gates.{run.suite.name}",
        )
        if not result.passed:
            message = (
                f"{result.gate.score}: expected {result.gate.relation} "
                f"{number(result.gate.bound)}, found {number(result.found)}"
            )
            failure = Failure(message, "gate")
            failure.text = result.gate.reason
            case.result = [failure]
        suite.add_testcase(case)
    document = JUnitXml()
    document.add_testsuite(suite)
    buffer = BytesIO()
    document.write(buffer)
    return buffer.getvalue().decode("utf-8")
