"""Range formats, a file each."""

from rockshape.io.range import npy, npz, ply, png, tiff

FORMATS = (npy.FORMAT, npz.FORMAT, tiff.FORMAT, png.FORMAT, ply.FORMAT)
