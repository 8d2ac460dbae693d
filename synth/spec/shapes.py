"""Parameters of drawn shapes: the names of the series and the pen's jitter."""

CHART = "krumbein"
SERIES_NAMES = ("roundness", "sphericity", "both", CHART, "rough", "rippled", "jagged")
JITTER_RMS_PX = 0.35
MAX_JITTER_PX = 5.0
SIZES_PX = (30.0, 1000.0)  # limits of the long side
