"""What a run leaves behind: a page, a summary, scores, records and a JUnit file."""

from validation.report.folder import check_target, write_run

__all__ = ["check_target", "write_run"]
