"""Image formats, a file each."""

from rockshape.io.images import jpeg, png, tiff

FORMATS = (png.FORMAT, jpeg.FORMAT, tiff.FORMAT)
