"""Where the examples lie that the tests measure."""

from pathlib import Path

ROOT = Path(__file__).parent.parent
EXAMPLES = ROOT / "examples"
MARS_IMAGE = EXAMPLES / "mars" / "i944014r.png"
MARS_RANGE = EXAMPLES / "mars" / "i944014r_xyz.npz"
GRAINS_IMAGE = EXAMPLES / "grains" / "1_P1060330_1.jpg"
GRAINS_LABELS = EXAMPLES / "grains" / "1_P1060330_1_mask.tif"
