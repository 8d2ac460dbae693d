"""Camera formats, a file each."""

from rockshape.io.cameras import (
    bop_scene,
    colmap,
    middlebury,
    nerfstudio,
    open3d,
    opencv_storage,
    pds_cahv,
    pinhole_json,
    realsense,
    ros,
)

FORMATS = (
    pinhole_json.FORMAT,
    bop_scene.FORMAT,
    opencv_storage.FORMAT,
    ros.FORMAT,
    open3d.FORMAT,
    nerfstudio.FORMAT,
    colmap.FORMAT,
    realsense.FORMAT,
    middlebury.FORMAT,
    pds_cahv.PDS3,
    pds_cahv.PDS4,
)
