"""PDS4 images."""

from rockshape.io.decoding.pds import is_pds4
from rockshape.io.decoding.pds_picture import decode_pds
from rockshape.io.format import ImageFormat

FORMAT = ImageFormat(
    name="PDS4",
    suffixes=(".xml",),
    summary="label beside its data, any numbers, bands as colours; with the extra `pds`",
    tested_with="PDS4 Standards Reference 1.16",
    sniff=is_pds4,
    read=decode_pds,
)
