"""The paper's tables 1 to 3 through the statistics that our own scores go through."""

from validation.paper import CONSISTENCY_TABLES, consistency_table
from validation.scores.agreement import STATISTICS


def paper_values() -> dict[str, dict[str, float]]:
    """{measure: {statistic: value}} for the paper's three roundness-type measures."""
    return {
        measure: {
            statistic.key: statistic.compute([consistency_table(number).block]).value
            for statistic in STATISTICS
        }
        for measure, number in CONSISTENCY_TABLES.items()
    }
