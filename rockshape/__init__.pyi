from . import measures as measures
from .arrays import measure as measure
from .camera import Camera as Camera
from .draw import overlay as overlay
from .errors import InputError as InputError
from .measurement import Measurement as Measurement
from .measurement import Rock as Rock
from .observation import Observation as Observation
