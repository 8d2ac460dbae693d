"""`rockshape measure`: the command's arguments.

The work is in `measure_image`, which is imported when the command runs: `--help` needs neither
NumPy nor OpenCV.
"""

import argparse
from pathlib import Path

from rockshape.commands.parser import examples
from rockshape.segmentation.finders import FINDERS

HELP = "find the rocks in an image and measure the shape of each"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples(
        "rockshape measure frame.png --range frame_xyz.npz --out rocks.csv --overlay rocks.png",
        "rockshape measure photos --labels masks --scale 0.39mm --out grains.parquet --jobs 2",
    )
    parser.add_argument(
        "images",
        nargs="+",
        metavar="IMAGE",
        help="image file, grey or colour, a PNG, JPEG or TIFF say; several, a folder, a pattern or "
        "a .txt list of them are measured into one table, and --labels, --range, --camera, ... "
        "may then be folders, whose files are paired by name, or patterns with {stem}",
    )
    inputs = parser.add_argument_group(
        "inputs", "`rockshape formats` lists all formats of each kind of file"
    )
    inputs.add_argument(
        "--range",
        type=Path,
        metavar="FILE",
        help="z-depth or 3-D point of each pixel, an NPZ or a 16-bit PNG say; without it the 3-D "
        "measures are empty",
    )
    inputs.add_argument(
        "--range-kind",
        choices=("depth", "distance", "disparity", "xyz"),
        help="what the range holds: z-depth, length along the ray, disparity or points, if not "
        "what its format and shape tell",
    )
    inputs.add_argument(
        "--range-unit",
        metavar="UNIT",
        help="unit of the range, m, mm or 0.25mm say: in place of metres, and of depth_scale for "
        "whole numbers, or of a stereo baseline; any distance is then believed",
    )
    inputs.add_argument(
        "--right",
        type=Path,
        metavar="FILE",
        help="right picture of a stereo pair of which IMAGE is the left one, in place of --range; "
        "--camera then describes both: a baseline_m, Q, or M1, M2, R and T of OpenCV, say",
    )
    inputs.add_argument(
        "--camera",
        type=Path,
        metavar="FILE",
        help="camera intrinsics, JSON with fx, fy, cx, cy say; needed for z-depth",
    )
    inputs.add_argument(
        "--camera-view",
        metavar="VIEW",
        help="which camera of a file of several, by its number or name (default: the image's)",
    )
    inputs.add_argument(
        "--labels",
        type=Path,
        metavar="FILE",
        help="rocks segmented already: label image (0 is the ground), COCO annotations, ...",
    )
    inputs.add_argument(
        "--instances",
        type=Path,
        metavar="FOLDER",
        help="the same as a folder of masks, one a rock, or a stack of masks in one file",
    )
    inputs.add_argument(
        "--pieces",
        choices=("split", "keep"),
        default="split",
        help="labels that are one mask without ids: a rock for each piece (default), or keep one",
    )
    inputs.add_argument(
        "--ignore",
        type=Path,
        metavar="FILE",
        help="mask, in any format of labels, of what is no rock: hardware, a scale bar, sky",
    )
    inputs.add_argument(
        "--max-pixels",
        type=int,
        default=2**27,
        metavar="N",
        help="refuse an image of more pixels before it is decoded (default: 134 million)",
    )
    how = parser.add_argument_group("measuring")
    how.add_argument(
        "--find",
        metavar="NAME",
        help="how rocks are found, if not as the method does: "
        + "; ".join(f"{finder.name}: {finder.summary}" for finder in FINDERS.values())
        + "; or a finder that a plug-in adds",
    )
    how.add_argument(
        "--method",
        default="robust",
        metavar="NAME",
        help="what is measured: robust, scale-free measures that resist noise (default); paper, "
        "those of Fox et al. (2002); or a method that a plug-in adds",
    )
    how.add_argument(
        "--descriptors",
        action="store_true",
        help="add outline descriptors: perimeter, Feret diameters, circularity, solidity, ...",
    )
    how.add_argument(
        "--sizes",
        action="store_true",
        help="add axes, Feret diameters, area, orientation and box in px, and in mm by range or a "
        "scale that the image's file tells",
    )
    how.add_argument(
        "--scale",
        metavar="SCALE",
        help="side of a pixel, 0.39mm say, or two ends of a scale bar, 40,52:540,52=100mm; adds "
        "the columns of --sizes",
    )
    how.add_argument(
        "--camera-height",
        metavar="LENGTH",
        help="height of the camera above level ground, 1.5m say, in place of range or --scale; "
        "with --tilt and --camera",
    )
    how.add_argument(
        "--tilt",
        type=float,
        metavar="DEG",
        help="how far the camera looks below the horizon",
    )
    how.add_argument(
        "--flags",
        action="store_true",
        help="add columns on what found each rock and how sure its outline is",
    )
    how.add_argument(
        "--uncertainty",
        action="store_true",
        help="add the standard deviation and the 90 %% interval of each value",
    )
    outputs = parser.add_argument_group("outputs")
    outputs.add_argument(
        "--out",
        type=Path,
        metavar="FILE",
        help="table of one row a rock: .csv, .json or .parquet (default: CSV on standard output)",
    )
    outputs.add_argument(
        "--labels-out",
        type=Path,
        metavar="FILE",
        help="labels of the rocks measured: PNG or TIFF of 16 bits, COCO (.json), GeoJSON or a "
        "RoiSet of ImageJ (.zip)",
    )
    outputs.add_argument(
        "--overlay",
        type=Path,
        metavar="FILE",
        help="image with outlines, ellipses and numbers: PNG, JPEG, TIFF or SVG",
    )
    outputs.add_argument(
        "--report",
        type=Path,
        metavar="FILE",
        help="HTML page with pictures, charts and table, of one image or all",
    )
    outputs.add_argument(
        "--map",
        type=Path,
        metavar="FILE",
        help="outlines in map coordinates with the table's values, GeoJSON; of a GeoTIFF",
    )
    outputs.add_argument(
        "--model",
        type=Path,
        metavar="FILE",
        help="points with each rock's ellipsoid and outline, binary glTF (.glb); needs range",
    )
    outputs.add_argument(
        "--json", action="store_true", help="print the table as JSON where --out names no file"
    )
    outputs.add_argument(
        "--quiet", action="store_true", help="tell nothing on standard error but errors"
    )
    batch = parser.add_argument_group("many images")
    batch.add_argument(
        "--jobs", type=int, metavar="N", help="processes (default: one for each processor)"
    )
    batch.add_argument(
        "--scheduler", metavar="ADDRESS", help="Dask scheduler in place of --jobs, tcp://host:8786"
    )
    batch.add_argument(
        "--resume", action="store_true", help="keep what an earlier run of this command has done"
    )
    batch.add_argument(
        "--strict", action="store_true", help="end with status 2 where any image failed"
    )


def run(args: argparse.Namespace) -> int:
    """Measure one image or many and write what was asked for."""
    # bring NumPy, OpenCV and pandas, half a second
    from rockshape.batch.images import is_batch  # noqa: PLC0415
    from rockshape.commands.measure_image import measure_image  # noqa: PLC0415
    from rockshape.commands.measure_options import MeasureOptions  # noqa: PLC0415

    args.image = Path(args.images[0])
    names = MeasureOptions.__dataclass_fields__
    options = MeasureOptions(**{name: getattr(args, name) for name in names})
    options.check_uncertainty()
    if not is_batch(args.images):
        measure_image(options)
        return 0
    from rockshape.commands.measure_batch import BatchOptions, measure_batch  # noqa: PLC0415

    return measure_batch(
        args.images,
        options,
        BatchOptions(args.jobs, args.scheduler, resume=args.resume, strict=args.strict),
    )
