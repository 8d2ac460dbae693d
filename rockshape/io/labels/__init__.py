"""Label formats, a file each."""

from rockshape.io.labels import coco, npy, png, tiff

FORMATS = (png.FORMAT, tiff.FORMAT, npy.FORMAT, coco.FORMAT)
