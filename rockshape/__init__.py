"""Measure the shape of rocks from an image and its range.

The parts, in the order data flows through them: `io` reads files, `observation` holds an image and
its range, `ground` and `segmentation` find the rocks, `outline`, `ellipse`, `ellipsoid` and
`surface` fit each, `measures` turns fits into numbers, `pipeline` joins all that, `table` and
`draw` show it.
"""
