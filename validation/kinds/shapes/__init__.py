"""Shape experiments: drawn series of known outlines."""

from validation.kinds.shapes.spec import ShapesExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="shapes",
    spec=ShapesExperiment,
    work="validation.kinds.shapes.work",
    judge="validation.kinds.shapes.judge",
    page="validation.kinds.shapes.page",
)
