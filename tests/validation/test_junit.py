"""JUnit file: well-formed whatever the texts hold, names unique, times there."""

import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest

from validation.report.junit import junit_xml
from validation.suite.gates import Gate, GateResult


def _read(*gates: Gate, passed: bool = False) -> ET.Element:
    run = SimpleNamespace(
        suite=SimpleNamespace(name="s"),
        gates=tuple(GateResult(gate, found=0.25, passed=passed) for gate in gates),
    )
    return ET.fromstring(junit_xml(run, seconds=12.3456))


@pytest.mark.parametrize(
    ("reason", "read"),
    [
        ("a\x00b\x1b[31mc\x7f", "a\ufffdb\ufffd[31mc\x7f"),
        ("]]> <![CDATA[ & < \"'", "]]> <![CDATA[ & < \"'"),
        ("\ud800 lone \udfff", "\ufffd lone \ufffd"),
        ("\ufffe\uffff", "\ufffd\ufffd"),
        ("≥ 𝜏 \U0001f600", "≥ 𝜏 \U0001f600"),
    ],
)
def test_any_reason_is_read_back(reason, read) -> None:
    failure = _read(Gate(score=reason, at_least=1.0, reason=reason)).find(".//failure")
    assert failure.text == read
    assert failure.get("message").startswith(read)


def test_names_differ_and_times_are_given() -> None:
    gates = [
        Gate(score="s.a", at_least=0.1234567, reason="r"),
        Gate(score="s.a", at_least=0.1234568, reason="r"),
        Gate(score="s.a", at_least=0.1234568, reason="another"),
        Gate(score="s.a", at_least=0.1234568, end="low", reason="r"),
    ]
    document = _read(*gates)
    cases = document.findall(".//testcase")
    assert len({case.get("name") for case in cases}) == len(gates)
    assert all(float(case.get("time")) == 0 for case in cases)
    assert float(document.find("testsuite").get("time")) == 12.346
    assert (document.get("tests"), document.get("failures")) == ("4", "4")
    assert _read(*gates, passed=True).get("failures") == "0"
