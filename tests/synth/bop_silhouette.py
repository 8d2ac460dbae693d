"""Silhouette by a renderer that counts pixels from the frame's corner.

`python bop_silhouette.py MODEL.ply POSE.json OUT.png`; a process of its own, for its OpenGL.
"""

import json
import os
import sys
from pathlib import Path

os.environ["PYOPENGL_PLATFORM"] = "osmesa"

import cv2
import numpy as np
import pyrender
import trimesh


def main() -> None:
    """Render the model at the pose with cx and cy as they are given."""
    model, pose_file, out = sys.argv[1:]
    table = json.loads(Path(pose_file).read_text())
    body = trimesh.load(model, process=False)
    pose = np.eye(4)
    pose[:3, :3] = np.array(table["cam_R_m2c"]).reshape(3, 3)
    pose[:3, 3] = table["cam_t_m2c"]
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh.from_trimesh(body), pose=np.diag([1.0, -1.0, -1.0, 1.0]) @ pose)
    camera = pyrender.IntrinsicsCamera(
        table["fx"], table["fy"], table["cx"], table["cy"], znear=100.0, zfar=50_000.0
    )
    scene.add(camera, pose=np.eye(4))
    renderer = pyrender.OffscreenRenderer(table["width"], table["height"])
    depth = renderer.render(scene, flags=pyrender.RenderFlags.DEPTH_ONLY)
    cv2.imwrite(out, 255 * (depth > 0).astype(np.uint8))


main()
