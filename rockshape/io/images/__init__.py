"""Image formats, a file each."""

from rockshape.io.images import bmp, jpeg, netpbm, pds3, pds4, png, tiff, webp

FORMATS = (
    png.FORMAT,
    jpeg.FORMAT,
    tiff.FORMAT,
    webp.FORMAT,
    bmp.FORMAT,
    netpbm.FORMAT,
    pds3.FORMAT,
    pds4.FORMAT,
)
