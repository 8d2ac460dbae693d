"""Command that fits the package's error models: `python -m training.uncertainty FILE.json`."""

import argparse
import json
from pathlib import Path

import pandas as pd

from training.uncertainty.fit import LEFT_OUT, as_json, fit_models, left_out_models
from training.uncertainty.pairs import FOUND
from training.uncertainty.scenes import FAMILIES
from training.uncertainty.table import PairSet, pair_table

FITTED = (
    PairSet("given", 1, 99, FAMILIES),
    PairSet("found", 1, 66, FAMILIES, ways=FOUND),
)


def main() -> None:
    """Make the rocks, fit, and write the files."""
    parser = argparse.ArgumentParser(prog="python -m training.uncertainty", description=__doc__)
    parser.add_argument("file", type=Path, help="error_model.json to write")
    parser.add_argument(
        "--left-out",
        type=Path,
        metavar="FILE",
        default=LEFT_OUT,
        help="models by family, each fitted to all others (%(default)s)",
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes (%(default)s)")
    said = parser.parse_args()
    pairs = pd.concat([pair_table(one, jobs=said.jobs) for one in FITTED], ignore_index=True)
    models = fit_models(pairs)
    said.file.write_text(json.dumps(as_json(models), indent=1) + "\n", encoding="utf-8")
    left_out = {family: as_json(each) for family, each in left_out_models(pairs).items()}
    said.left_out.write_text(json.dumps(left_out) + "\n", encoding="utf-8")
    print(f"written: {said.file}; {said.left_out}, {len(left_out)} families")


if __name__ == "__main__":
    main()
