"""Multi-view experiments: the same rocks seen from several views."""

from validation.kinds.multiview.spec import MultiviewExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="multiview",
    spec=MultiviewExperiment,
    work="validation.kinds.multiview.work",
    judge="validation.kinds.multiview.judge",
    page="validation.kinds.multiview.page",
    aliases=("yard",),
)
