"""The published tables and figures that every report sets beside ours.

Source: T. Fox, R. Castaño, R. C. Anderson, "Onboard Autonomous Rock Shape Analysis for Mars
Rovers", IEEE Aerospace Conference 2002, tables 1 to 5 and section 3. The CSV files hold the
printed figures and nothing else; `validation.paper.prose` holds those said in the text only.
"""

from validation.paper.tables import (
    CONSISTENCY_TABLES,
    GARDEN_COLUMNS,
    ConsistencyTable,
    consistency_table,
    garden_correlation,
    garden_rank_move,
    garden_table,
    ranking_table,
)

__all__ = [
    "CONSISTENCY_TABLES",
    "GARDEN_COLUMNS",
    "ConsistencyTable",
    "consistency_table",
    "garden_correlation",
    "garden_rank_move",
    "garden_table",
    "ranking_table",
]
