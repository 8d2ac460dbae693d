"""Command that fits the package's error models: `python -m training.uncertainty FILE.json`."""

import argparse
import json
from pathlib import Path

import pandas as pd

from training.uncertainty.fit import as_json, fit_models
from training.uncertainty.pairs import TAUGHT
from training.uncertainty.table import PairSet, pair_table

FITTED = (
    PairSet("fresh", 1, 60, TAUGHT),
    PairSet("more", 500, 30, TAUGHT),
    PairSet("worn", 2, 15, TAUGHT, worn=(0.2, 1.0)),
)


def main() -> None:
    """Make the rocks, fit, and write the file."""
    parser = argparse.ArgumentParser(prog="python -m training.uncertainty", description=__doc__)
    parser.add_argument("file", type=Path, help="error_model.json to write")
    parser.add_argument("--jobs", type=int, default=2, help="processes (%(default)s)")
    said = parser.parse_args()
    pairs = pd.concat([pair_table(one, jobs=said.jobs) for one in FITTED], ignore_index=True)
    models = fit_models(pairs)
    said.file.write_text(json.dumps(as_json(models), indent=1) + "\n", encoding="utf-8")
    print(f"written: {said.file}, {len(models)} models")


if __name__ == "__main__":
    main()
