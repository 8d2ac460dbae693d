"""PDS3 images."""

from rockshape.io.decoding.pds import is_pds3
from rockshape.io.decoding.pds_picture import decode_pds
from rockshape.io.format import ImageFormat

FORMAT = ImageFormat(
    name="PDS3",
    suffixes=(".img", ".lbl"),
    summary="attached or detached label, any numbers, bands as colours; with the extra `pds`",
    tested_with="PDS Standards Reference 3.8",
    sniff=is_pds3,
    read=decode_pds,
)
