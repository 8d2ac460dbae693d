"""One page about one measurement: the picture and the table."""

from rockshape.report.page import render_page

__all__ = ["render_page"]
