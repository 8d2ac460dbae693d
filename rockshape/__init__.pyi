from . import measures as measures
from .api import measure as measure
from .camera.camera import Camera as Camera
from .errors import InputError as InputError
from .measurement import Measurement as Measurement
from .measurement import Rock as Rock
from .observation import Observation as Observation
from .report.overlay import overlay as overlay
