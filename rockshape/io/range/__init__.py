"""Range formats, a file each."""

from rockshape.io.range import exr, imp_table, netpbm, npy, npz, pcd, pds, pfm, ply, png, tiff

FORMATS = (
    npy.FORMAT,
    npz.FORMAT,
    tiff.FORMAT,
    png.FORMAT,
    netpbm.FORMAT,
    pfm.FORMAT,
    exr.FORMAT,
    ply.FORMAT,
    pcd.FORMAT,
    pds.PDS3,
    pds.PDS4,
    imp_table.FORMAT,
)
