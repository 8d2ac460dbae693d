"""Label formats, a file each."""

from rockshape.io.labels import (
    bmp,
    cellpose,
    coco,
    detections,
    geojson,
    imagej_roi,
    labelme,
    mask_folder,
    npy,
    npz,
    pgm,
    png,
    tiff,
    webp,
    yolo,
)

FORMATS = (
    png.FORMAT,
    tiff.FORMAT,
    cellpose.FORMAT,
    npy.FORMAT,
    imagej_roi.ROI_SET,
    imagej_roi.ROI,
    npz.FORMAT,
    bmp.FORMAT,
    pgm.FORMAT,
    webp.FORMAT,
    labelme.FORMAT,
    geojson.FORMAT,
    detections.SAM,
    detections.RESULTS,
    coco.FORMAT,
    yolo.FORMAT,
    mask_folder.FORMAT,
)
