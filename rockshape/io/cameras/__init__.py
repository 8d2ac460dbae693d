"""Camera formats, a file each."""

from rockshape.io.cameras import pinhole_json

FORMATS = (pinhole_json.FORMAT,)
