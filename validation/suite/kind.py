"""Kind of experiment: a spec, and the modules that do its work, judge it and show it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from validation.suite.experiment import Experiment

Table = Mapping[str, Any]


@dataclass(frozen=True)
class Kind:
    """A kind of experiment; the modules are named, and imported when they are first asked for.

    A worker imports the spec and the work alone, so that neither scores nor drawings change the
    key of a result. The three modules may be one.
    """

    name: str  # of the table's key `kind`, of the records' column `kind` and of the spec's tag
    spec: type[Experiment]
    work: str  # module of the protocol validation.execution.work.Work
    judge: str  # module of the protocol validation.scores.judge.Judge
    page: str  # module of the protocol validation.report.section.Page
    aliases: tuple[str, ...] = ()  # names by which older suites and results know it
    adopts: Callable[[Table], bool] | None = None  # which tables of an alias are of this kind

    @property
    def never_in_workers(self) -> tuple[str, ...]:
        """Modules that no worker loads: those that judge and show, where they are apart."""
        loaded = (self.work, self.spec.__module__)
        return tuple(each for each in (self.judge, self.page) if each not in loaded)

    def __post_init__(self) -> None:
        """Ask for the name as the tag of the spec."""
        tag = self.spec.__struct_config__.tag
        if tag != self.name:
            raise ValueError(
                f"kind {self.name!r}: expected {self.spec.__name__} with tag={self.name!r}, "
                f"found {tag!r}"
            )


def folder_kind(
    package: str,
    spec: type[Experiment],
    *,
    work: str = "",
    aliases: tuple[str, ...] = (),
    adopts: Callable[[Table], bool] | None = None,
) -> Kind:
    """Kind of a folder that holds the modules `work`, `judge` and `page`, called as its spec's tag.

    `work` names another module where the kind does the work of another.
    """
    return Kind(
        name=str(spec.__struct_config__.tag),
        spec=spec,
        work=work or f"{package}.work",
        judge=f"{package}.judge",
        page=f"{package}.page",
        aliases=aliases,
        adopts=adopts,
    )
